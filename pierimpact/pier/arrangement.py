"""What a column is made of, for statics and for vibration: uniform parts between two supports."""

import math
from itertools import pairwise
from typing import NamedTuple

from pierimpact.checks import InputError

# Numerical: joints closer than this share of the height are one. Moving one as far changes the
# column as little as the round-off of so short a part does.
CLOSE = 1e-8


class Part(NamedTuple):
    """A uniform part of a column, between two heights."""

    bottom: float  #: [m]
    top: float  #: [m]
    flexural_rigidity: float  #: EI [N m²]
    shear_rigidity: float  #: κGA [N]
    mass_per_length: float  #: m̄ = ρA [kg/m]
    rotary_inertia: float  #: ρI, per length [kg m]

    @property
    def length(self) -> float:
        """Length [m]."""
        return self.top - self.bottom


class Support(NamedTuple):
    """What resists the movement of an end: springs, from 0 where it is free to ∞ where it is held.

    The springs act on the deflection and on the rotation, and do not act on each other.
    """

    stiffness: float  #: lateral [N/m]
    rotation_stiffness: float  #: [N m/rad]

    @property
    def kind(self) -> str:
        """What holds the end in a word or two."""
        if 0.0 < self.stiffness < math.inf or 0.0 < self.rotation_stiffness < math.inf:
            return "on springs"
        if self.stiffness == 0.0:
            return "free" if self.rotation_stiffness == 0.0 else "held in rotation"
        return "pinned" if self.rotation_stiffness == 0.0 else "fixed"

    def work(self, force: float, moment: float) -> float:
        """Return the work R²/k + M²/k_θ that its springs take up, twice their energy [J]."""
        actions = ((force, self.stiffness), (moment, self.rotation_stiffness))
        return sum(action**2 / stiffness for action, stiffness in actions if stiffness > 0.0)


#: By the names of the end conditions.
SUPPORTS = {
    "fixed": Support(math.inf, math.inf),
    "pinned": Support(math.inf, 0.0),
    "free": Support(0.0, 0.0),
}


class Arrangement(NamedTuple):
    """A column as parts from the base upward, its supports, and the mass at its top."""

    parts: tuple[Part, ...]
    base: Support
    top: Support
    top_mass: float = 0.0  #: [kg]

    def with_joint(self, height: float) -> tuple["Arrangement", int]:
        """Return the same column with a joint at a height [m], and the number of parts below it.

        A joint between two parts that is all but there is moved there: 0.9144 and 3 × 0.3048 differ
        by round-off, and a part that short would leave nothing but round-off of the column.
        """
        joints = [self.parts[0].bottom, *(part.top for part in self.parts)]
        near = CLOSE * joints[-1]
        joints[1:-1] = [height if abs(joint - height) < near else joint for joint in joints[1:-1]]
        parts = []
        for part, (bottom, top) in zip(self.parts, pairwise(joints), strict=True):
            cut = [height] if bottom < height < top else []
            ends = pairwise([bottom, *cut, top])
            parts += [part._replace(bottom=low, top=high) for low, high in ends]
        return self._replace(parts=tuple(parts)), sum(part.top <= height for part in parts)


def refuse_mechanism(base: Support, top: Support) -> None:
    """Refuse supports that leave a movement of the whole column free.

    Raises
    ------
    InputError
        When they do; it says which movement that is.
    """
    held = {name: end.stiffness > 0.0 for name, end in (("base", base), ("top", top))}
    turns = not (base.rotation_stiffness > 0.0 or top.rotation_stiffness > 0.0)
    if not any(held.values()):
        free = "to move sideways" + (" and to rotate" if turns else "")
    elif turns and not all(held.values()):
        free = f"to rotate about its {'base' if held['base'] else 'top'}"
    else:
        return
    raise InputError(
        f"base and top leave the column a mechanism, free {free}: one end must be fixed, or both "
        "pinned, or springs given in place of what is missing"
    )
