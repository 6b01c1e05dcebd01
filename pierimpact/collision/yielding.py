"""A pier that yields: its spring is elastic–perfectly plastic, in both directions.

The equations of motion measure x_p from where the pier's spring is unstressed, so that those of the
elastic pier hold as they are. While the spring yields, its force stays at ±R_y and x_p goes beyond
±R_y/k_p; when the pier turns back, what lies beyond has become plastic, and x_p is measured anew.
"""

from typing import NamedTuple

from pierimpact.collision.series import Flag, Ops, Real

# Events: the spring begins to yield in the direction of travel or against it, or the pier turns.
YIELDS_FORWARD, YIELDS_BACKWARD, YIELDING_ENDS = 9, 10, 11

ROUND_OFF = 1e-12  # numerical, relative: an undamped pier that has yielded swings as far again
HARDLY = 1e-11  # numerical, relative to the largest displacement of the pier


class Yielding(NamedTuple):
    """How a pier yields, and has yielded so far."""

    limit: Real  # R_y/k_p [m]
    direction: Real  # 1 or −1 while it yields, else 0
    displacement: Real  # plastic displacement, but for what `beyond` has [m]
    path: Real  # the same with all yielding counted positive [m]
    largest: Real  # largest |x_p| so far, measured from where the pier stood at first touch [m]

    def elastic_part(self, xp: Real, ops: Ops) -> Real:
        """Return the elastic part R/k_p of a displacement [m]."""
        where, limit = ops.where, self.limit
        return where(xp > limit, limit, where(xp < -limit, -limit, xp))

    def beyond(self, xp: Real, ops: Ops) -> Real:
        """Return what of a displacement has become plastic since the pier began to yield [m]."""
        return ops.where(self.direction != 0.0, xp - self.direction * self.limit, 0.0)

    def reach(self, xp: Real, counts: Flag, ops: Ops) -> "Yielding":
        """Return the same once the pier has been at `xp`, where that `counts`."""
        size = abs(self.displacement + xp)
        return self._replace(largest=ops.where(counts & (size > self.largest), size, self.largest))

    def after(self, event: Real, xp: Real, ops: Ops) -> tuple["Yielding", Real]:
        """Return the same after `event` at the displacement `xp`, and the displacement anew."""
        where = ops.where
        ends = event == YIELDING_ENDS
        more = where(ends, self.beyond(xp, ops), 0.0)
        new = self._replace(
            direction=where(
                event == YIELDS_FORWARD,
                1.0,
                where(event == YIELDS_BACKWARD, -1.0, where(ends, 0.0, self.direction)),
            ),
            displacement=self.displacement + more,
            path=self.path + abs(more),
        )
        return new, xp - more
