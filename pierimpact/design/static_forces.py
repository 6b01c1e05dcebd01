"""Where member forces under the reaction as a static force hold in one collision.

The blow of the engine reaches the nearest support before the column deflects in its static shape.
So the reaction stands for it where it is as large as the largest contact force; else the static
shear is to that of the column as a beam about as the reaction to the contact force. Under the
larger of the two as a static force, shear and moment are seldom too low.

Rule and figures are this project's, from the study in `pierimpact.design.static_study`.
"""

from typing import NamedTuple

from pierimpact.pier.static_forces import TOP, Ratios, StaticForces, too_low

#: Reaction over the largest contact force, from which on the one is as large as the other, from
#: the study.
AS_LARGE = 0.95
ABOVE, BELOW = "reaction as large as the contact force", "reaction below the contact force"
#: What the static forces are of those of the beam where the reaction is below the contact force,
#: times the contact force over the reaction; from the study.
RATIOS_BELOW = Ratios((0.95, 1.29), (1.11, 1.67))


class StaticForcesInCollision(NamedTuple):
    """Whether member forces under a reaction as a static force hold in one collision."""

    column: StaticForces
    reaction: float  #: R [N]
    contact_force: float  #: largest contact force of the full model [N]

    @property
    def kind(self) -> str:
        """One of ABOVE, BELOW and, whatever the forces, `pierimpact.pier.static_forces.TOP`."""
        if self.column.kind == TOP:
            return TOP
        return ABOVE if self.reaction >= AS_LARGE * self.contact_force else BELOW

    @property
    def hold(self) -> bool:
        """Whether they hold: seldom are they much too low."""
        return self.kind == ABOVE

    @property
    def sentence(self) -> str:
        """What to know before relying on them, in one sentence; empty where they hold."""
        if self.kind != BELOW:
            return self.column.sentence if self.kind == TOP else ""
        share = self.reaction / self.contact_force
        (least, most), (low, high) = RATIOS_BELOW
        reason = (
            f"the reaction is only {share:.2f} times the largest contact force, which the column "
            "passes to its nearest support before it deflects in its static shape"
        )
        return too_low(reason, Ratios((share * least, share * most), (share * low, share * high)))
