"""A column of any arrangement under a unit force at one height, exactly.

Derived here. In a uniform part under no load the shear V is constant, and with s upward from its
lower end

M = M_0 + V s, θ = θ_0 − (M_0 s + V s²/2)/EI, x = x_0 + θ_0 s − (M_0 s²/2 + V s³/6)/EI + V s/κGA.

Of deflection x, rotation θ, shear V and moment M a support leaves two unknown: of each pair, x and
V or θ and M, one follows from the other by the support's spring. So from either end up to the
impact the states are sums of two known ones, and the conditions at the impact, where x, θ and M
pass on and V drops by the force, make four equations for four unknowns. Seen from the top the same
holds with θ and V of the opposite sign.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.pier.arrangement import Arrangement, Part, Support

Array: TypeAlias = NDArray[np.float64]

# Deflection, rotation, shear and moment; seen from the end where the walk began.
_State: TypeAlias = tuple[float, float, float, float]
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(4)  # exact for squares of cubics


class Piece(NamedTuple):
    """A part of the column: its shear, the moments at its ends, and its deflection, a cubic in s.

    All is per unit of force. The moment changes linearly. The distance s runs from the joint at
    `start`, upward below the impact and downward above it, so that no figures are lost close to a
    support.
    """

    part: Part
    V: float  #: [-]
    M_bottom: float  #: [m]
    M_top: float  #: [m]
    start: float  #: height where s = 0 [m]
    coefficients: tuple[float, ...]  #: of c0 + c1 s + c2 s² + c3 s³ [m/N, 1/N, …]

    def deflection(self, z: float | Array) -> Array:
        """Deflection at heights within the part [m/N]."""
        return np.asarray(self._cubic(np.abs(z - self.start)))

    def _cubic(self, s: Any) -> Any:
        c0, c1, c2, c3 = self.coefficients
        return c0 + s * (c1 + s * (c2 + s * c3))

    def ending(self, deflection: float) -> "Piece":
        """Return the same piece with this deflection where s ends, its cubic term changed."""
        *others, c3 = self.coefficients
        length = self.part.length
        short = deflection - self._cubic(length)
        return self._replace(coefficients=(*others, c3 + short / length**3))

    @property
    def square(self) -> float:
        """Integral of the squared deflection over the part [m³/N²]."""
        half = 0.5 * self.part.length
        return float(half * (_WEIGHTS @ self._cubic(half + half * _NODES) ** 2))

    @property
    def work(self) -> float:
        """What the part adds to the deflection at the impact [m/N]."""
        return self.flexure + self.shearing

    @property
    def flexure(self) -> float:
        """What the part's flexure adds to the deflection at the impact, ∫ M²/EI dz [m/N]."""
        squares = self.M_bottom**2 + self.M_bottom * self.M_top + self.M_top**2
        return self.part.length * squares / (3.0 * self.part.flexural_rigidity)

    @property
    def shearing(self) -> float:
        """What the part's shear adds to the deflection at the impact, ∫ V²/κGA dz [m/N]."""
        return self.part.length * self.V**2 / self.part.shear_rigidity


@dataclass(frozen=True, kw_only=True)
class UnitForce:
    """A column under a unit force in the direction of travel; all is per unit of that force.

    Support forces are positive against the direction of travel; moments are positive where the
    face away from the truck is in tension.
    """

    arrangement: Arrangement
    pieces: tuple[Piece, ...]  #: from the base upward
    deflection: float  #: at the impact [m/N]
    base_force: float  #: [-]
    top_force: float  #: [-]
    base_moment: float  #: [m]
    top_moment: float  #: [m]

    def deflections(self, z: Array) -> Array:
        """Deflection at heights z [m], in the shape of z [m/N]."""
        place = np.searchsorted([piece.part.top for piece in self.pieces[:-1]], z)
        values = np.empty_like(z)
        for number, piece in enumerate(self.pieces):
            here = place == number
            values[here] = piece.deflection(z[here])
        return values

    @cached_property
    def mass(self) -> float:
        """Equivalent mass ∫ m̄ φ² dz + m_t φ(H)² (Eq. 1 of the source paper) [kg]."""
        squares = sum(piece.part.mass_per_length * piece.square for piece in self.pieces)
        if self.arrangement.top_mass:
            highest = self.pieces[-1]
            squares += self.arrangement.top_mass * float(highest.deflection(highest.part.top)) ** 2
        return squares / self.deflection**2


def unit_force(arrangement: Arrangement, impact_height: float) -> UnitForce:
    """Return a column under a unit force at a height [m], where it is not held."""
    arrangement, below = arrangement.with_joint(impact_height)
    parts = arrangement.parts
    # By this scale the unknowns are of the order of 1, however stiff and long the column.
    length, first = parts[-1].top - parts[0].bottom, parts[0]
    flexibility = length**3 / first.flexural_rigidity + length / first.shear_rigidity
    scale = (flexibility, flexibility / length, 1.0, length)
    ways = ((arrangement.base, parts[:below]), (arrangement.top, parts[below:][::-1]))
    starts = [_unknowns(support, scale) for support, _ in ways]
    ends = [
        _walk(start, way)[-1] for pair, (_, way) in zip(starts, ways, strict=True) for start in pair
    ]
    # Deflection, rotation and moment pass on; the shear drops by the force.
    signs = np.array([[1, 1, -1, -1], [1, 1, 1, 1], [1, 1, 1, 1], [1, 1, -1, -1]])
    conditions = signs * np.transpose(ends) / np.array(scale)[:, None]
    columns = np.abs(conditions).max(axis=0)
    conditions /= columns
    rows = np.abs(conditions).max(axis=1)
    drop = np.array([0.0, 0.0, 1.0, 0.0])
    shares = (np.linalg.solve(conditions / rows[:, None], drop / rows) / columns).tolist()
    walks = []
    for (lateral, rotational), (one, other), (_, way) in zip(
        (shares[:2], shares[2:]), starts, ways, strict=True
    ):
        start = [lateral * a + rotational * b for a, b in zip(one, other, strict=True)]
        walks.append(_walk(start, way))
    below_impact, above_impact = (
        [
            _piece(part, *states, downward=downward)
            for part, states in zip(way, pairwise(walk), strict=True)
        ]
        for (_, way), walk, downward in zip(ways, walks, (False, True), strict=True)
    )
    base, top = (walk[0][2:] for walk in walks)
    # The work of the unit force; the walk to an impact close to a support would give the
    # deflection as a difference of large numbers.
    deflection = arrangement.base.work(*base) + arrangement.top.work(*top)
    deflection += sum(piece.work for piece in (*below_impact, *above_impact))
    for pieces in (below_impact, above_impact):
        pieces[-1:] = [piece.ending(deflection) for piece in pieces[-1:]]
    return UnitForce(
        arrangement=arrangement,
        pieces=(*below_impact, *above_impact[::-1]),
        deflection=deflection,
        base_force=base[0],
        top_force=top[0],
        base_moment=base[1],
        top_moment=top[1],
    )


def _unknowns(support: Support, scale: _State) -> tuple[_State, _State]:
    """Return the two states that a support allows: of deflection and V, of rotation and M."""
    deflection, rotation, force, moment = scale
    lateral = support.stiffness * deflection / force
    rotational = support.rotation_stiffness * rotation / moment
    return (
        (deflection / (1.0 + lateral), 0.0, force * _share(lateral), 0.0),
        (0.0, rotation / (1.0 + rotational), 0.0, -moment * _share(rotational)),
    )


def _share(ratio: float) -> float:
    """Return r/(1 + r), for r from 0 to ∞."""
    return 1.0 / (1.0 + 1.0 / ratio) if ratio > 0.0 else 0.0


def _walk(state: Iterable[float], parts: Iterable[Part]) -> list[_State]:
    """Return the states at the joints of parts one after the other, from one to begin with."""
    x, theta, V, M = state
    states = [(x, theta, V, M)]
    for part in parts:
        s, EI, GA = part.length, part.flexural_rigidity, part.shear_rigidity
        x += s * (theta + V / GA) - s**2 * (M / 2.0 + V * s / 6.0) / EI
        theta -= s * (M + V * s / 2.0) / EI
        M += V * s
        states.append((x, theta, V, M))
    return states


def _piece(part: Part, state: _State, after: _State, *, downward: bool) -> Piece:
    """Return a part with the states at its joints, in the order of the walk."""
    (x, theta, V, M), EI = state, part.flexural_rigidity
    cubic = (x, theta + V / part.shear_rigidity, -M / (2.0 * EI), -V / (6.0 * EI))
    if downward:  # 0.0 − V: a plain sign change would print an unloaded end as −0
        return Piece(part, 0.0 - V, after[-1], M, part.top, cubic)
    return Piece(part, V, M, after[-1], part.bottom, cubic)
