"""The pier as a beam: natural modes of a Timoshenko beam, and the flexibility they leave out."""

from dataclasses import dataclass, field, replace
from typing import TypeAlias

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from pierimpact.checks import whole
from pierimpact.pier.arrangement import Arrangement
from pierimpact.pier.equivalent import EquivalentPier
from pierimpact.pier.member_forces import within

Array: TypeAlias = NDArray[np.float64]

# Numerical settings.
HIGHEST_FREQUENCY = 2500.0  # up to which modes are kept [Hz]
FEWEST_MODES, MOST_MODES = 8, 64
MOST_ASKED = 200  # modes, far beyond those that a collision excites
INTERVALS = 60  # about as many between the heights at which shear and moment are evaluated


@dataclass(frozen=True, kw_only=True, eq=False)
class BeamPier:
    """A pier as a beam, by its natural modes.

    The beam moves in n shapes, normalised to a modal mass of 1 kg. Each obeys
    q'' + 2 ζ ω q' + ω² q = φ(z_n) F, and deflection, shear and moment are the sums Σ φ(z) q,
    Σ V(z) q and Σ M(z) q. The last shape is a residual vector: the static deflection under a
    force at z_n less the share of the natural modes kept. It is orthogonal to them, and makes the
    sums exact for a static force; Σ φ(z_n)²/ω² is 1/k_p.

    Parameters
    ----------
    equivalent : EquivalentPier
        The same pier as one degree of freedom; its damping ratio ζ is that of every shape.
    circular_frequencies : ndarray, shape (n,)
        Circular frequencies ω of the natural modes, ascending, and of the residual [rad/s].
    impact_deflection : ndarray, shape (n,)
        Deflection φ(z_n) of each shape [kg^-½].
    z : ndarray, shape (m,)
        Heights from 0 to H; where two parts meet the height is there twice, as at the impact:
        first for the part below it, then for that above [m].
    deflection, shear, moment : ndarray, shape (n, m)
        Deflection φ [kg^-½], shear V [N/(m kg^½)] and moment M [N/kg^½] of each shape at `z`, by
        the sign convention of `pierimpact.pier.member_forces`.

    Examples
    --------
    >>> from pierimpact import CircularSection, PierColumn
    >>> column = PierColumn(
    ...     height=5.0, section=CircularSection(diameter=0.9), elastic_modulus=25e9, density=2400.0
    ... )
    >>> beam = column.beam(impact_height=1.2)
    >>> beam.frequencies[:2].round(1)  # Hz
    array([ 65.9, 191.6])
    >>> round(beam.equivalent.frequency, 1)  # Hz, of the shape under a static force
    85.0
    """

    equivalent: EquivalentPier
    circular_frequencies: Array = field(repr=False)
    impact_deflection: Array = field(repr=False)
    z: Array = field(repr=False)
    deflection: Array = field(repr=False)
    shear: Array = field(repr=False)
    moment: Array = field(repr=False)

    @property
    def frequencies(self) -> Array:
        """Frequencies of the natural modes, shape (n − 1,) [Hz]."""
        return self.circular_frequencies[:-1] / (2.0 * np.pi)

    @property
    def damping(self) -> Array:
        """Damping 2 ζ ω of each shape, shape (n,) [1/s]."""
        return 2.0 * self.equivalent.damping_ratio * self.circular_frequencies

    @property
    def effective_mass(self) -> float:
        """Mass 1/Σ φ(z_n)² that resists a sudden force at z_n [kg]."""
        return float(1.0 / np.sum(self.impact_deflection**2))

    def weighted(self, shear: Array, moment: Array) -> "BeamPier":
        """Return the same beam, its shear and moment times weights at `z`, each of shape (m,)."""
        return replace(self, shear=self.shear * shear, moment=self.moment * moment)

    def between(self, low: float, high: float) -> "BeamPier":
        """Return the same beam, whose fields are those of its heights from one to another [m]."""
        own = within(self.z, low, high)
        fields = {name: getattr(self, name)[:, own] for name in ("deflection", "shear", "moment")}
        return replace(self, z=self.z[own], **fields)

    def up_to(self, frequency: float, most: int = MOST_ASKED) -> "BeamPier":
        """Return the same beam with its natural modes up to a frequency [Hz], from one to `most`.

        Its other shapes become one, so that it is exact for a static force as before.
        """
        count = int(np.searchsorted(self.frequencies, frequency, side="right"))
        kept = max(1, min(count, most))
        omega, phi = self.circular_frequencies, self.impact_deflection
        if kept == len(omega):  # a single shape, and no residual
            return self
        residual, shares = _residual(omega[kept:], phi[kept:])

        def with_residual(shapes: Array) -> Array:
            return np.concatenate((shapes[:kept], [shares @ shapes[kept:]]))

        return replace(
            self,
            circular_frequencies=np.append(omega[:kept], residual),
            impact_deflection=with_residual(phi),
            deflection=with_residual(self.deflection),
            shear=with_residual(self.shear),
            moment=with_residual(self.moment),
        )


def _residual(omega: Array, phi: Array) -> tuple[float, Array]:
    """Return shapes as one: its circular frequency, and the share that it has of each.

    It is their static deflection under a force at z_n, normalised: with stiffness and mass
    Σ φ²/ω² and Σ φ²/ω⁴ before.
    """
    static = phi / omega**2
    flexibility, mass = static @ phi, static @ static
    return float(np.sqrt(flexibility / mass)), static / np.sqrt(mass)


def beam_pier(
    arrangement: Arrangement, struck: int, equivalent: EquivalentPier, modes: int | None = None
) -> BeamPier:
    """Return the beam of a column.

    Parameters
    ----------
    arrangement : Arrangement
        Its parts, with a joint at the impact, between its supports.
    struck : int
        Number of parts below the impact.
    equivalent : EquivalentPier
        The same pier as one degree of freedom.
    modes : int, optional
        Number of natural modes to keep. The default keeps those up to 2.5 kHz and one more, from 8
        to 64: the largest moment of a collision with a concrete column is then converged to 0.5 %,
        and the reaction to 0.1 %; the largest shear to 0.5 % as well, but of slender columns up to
        some 3 % more than with more modes. The shear of light steel posts is to some 10 %.

    Raises
    ------
    InputError
        When `modes` is not a whole number from 1 to 200.
    """
    modes = None if modes is None else whole("modes", modes, 1, MOST_ASKED)
    highest, count = 2.0 * np.pi * HIGHEST_FREQUENCY, modes or FEWEST_MODES
    elements = Elements(arrangement, count)
    omega, shapes = elements.modes()
    if modes is None:
        while omega[count - 1] < highest and count < MOST_MODES:
            count *= 2
            elements = Elements(arrangement, count)
            omega, shapes = elements.modes()
        count = min(max(FEWEST_MODES, int(np.searchsorted(omega, highest)) + 1), MOST_MODES)

    residual, shares = _residual(omega[count:], shapes[struck, count:])
    shapes = np.column_stack((shapes[:, :count], shapes[:, count:] @ shares))
    z, deflection, shear, moment = elements.fields(shapes)
    return BeamPier(
        equivalent=equivalent,
        circular_frequencies=np.append(omega[:count], residual),
        impact_deflection=shapes[struck],
        z=z,
        deflection=deflection,
        shear=shear,
        moment=moment,
    )


class Elements:
    """A beam as finite elements, one for each part, with polynomials of a high degree.

    Deflection and rotation of an element are each a straight line between its two joints and
    integrated Legendre polynomials, which vanish there (the p-version of the finite element
    method: Szabó & Babuška, Finite Element Analysis, 1991). The static deflection under forces
    at joints is a cubic, and so exact; the modes converge faster than any power of the degree.

    The unknowns are the deflections of the joints and of the interiors of the elements, then the
    rotations in the same order.
    """

    def __init__(self, arrangement: Arrangement, modes: int) -> None:
        parts, supports = arrangement.parts, (arrangement.base, arrangement.top)
        height = parts[-1].top - parts[0].bottom
        self.elements = []  # part, degree and places of its unknowns among those of one kind
        size = len(parts) + 1
        for number, part in enumerate(parts):
            # Two for a half-wave of the shortest mode, and some for its sharp bends at the ends.
            degree = 12 + 2 * int(np.ceil(modes * part.length / height))
            places = np.concatenate(([number, number + 1], size + np.arange(degree - 1)))
            self.elements.append((part, degree, places))
            size += degree - 1
        # Springs of the supports in the order of the unknowns, ∞ where one is held; top mass.
        self.springs, self.masses = np.zeros((2, 2, size))
        self.springs[:, [0, len(parts)]] = np.transpose(supports)
        self.masses[0, len(parts)] = arrangement.top_mass
        self.moves = np.isfinite(self.springs).ravel()

    def modes(self) -> tuple[Array, Array]:
        """Return circular frequencies, ascending, and mass-normalised shapes, in columns."""
        free = np.ix_(self.moves, self.moves)
        stiffness, mass = (matrix[free] for matrix in self.matrices())
        stiffness += np.diag(self.springs.ravel()[self.moves])
        mass += np.diag(self.masses.ravel()[self.moves])
        # The stiffness is factorised rather than the mass: the lowest modes have least round-off.
        inverse = np.linalg.inv(np.linalg.cholesky(stiffness))
        squares, vectors = np.linalg.eigh(inverse @ mass @ inverse.T)
        # Of the highest modes of a short element nothing but round-off may be left.
        omega = 1.0 / np.sqrt(np.maximum(squares[::-1], np.finfo(float).eps * squares[-1]))
        shapes = np.zeros((len(self.moves), len(omega)))
        shapes[self.moves] = inverse.T @ vectors[:, ::-1] * omega
        return omega, shapes

    def matrices(self) -> tuple[Array, Array]:
        """Return the matrices of stiffness and mass, without supports and the mass at the top."""
        size = len(self.moves) // 2
        bending, coupling, shearing, deflecting, rotating = np.zeros((5, size, size))
        for part, degree, places in self.elements:
            xi, weights = legendre.leggauss(degree + 1)
            value, slope = _functions(degree, xi, part.length)
            weights = 0.5 * part.length * weights[:, None]
            values, slopes = value.T @ (weights * value), slope.T @ (weights * slope)
            at = np.ix_(places, places)
            shearing[at] += part.shear_rigidity * slopes
            coupling[at] -= part.shear_rigidity * slope.T @ (weights * value)
            bending[at] += part.flexural_rigidity * slopes + part.shear_rigidity * values
            deflecting[at] += part.mass_per_length * values
            rotating[at] += part.rotary_inertia * values
        stiffness = np.block([[shearing, coupling], [coupling.T, bending]])
        none = np.zeros_like(rotating)
        return stiffness, np.block([[deflecting, none], [none, rotating]])

    def fields(self, shapes: Array) -> tuple[Array, Array, Array, Array]:
        """Return heights, shape (m,), and deflection, shear and moment there, shape (n, m)."""
        deflections, rotations = np.split(shapes, 2)
        height = sum(part.length for part, _, _ in self.elements)
        rows = []
        for part, degree, places in self.elements:
            count = 1 + max(4, round(INTERVALS * part.length / height))
            value, slope = _functions(degree, np.linspace(-1.0, 1.0, count), part.length)
            w, theta = deflections[places], rotations[places]
            z = np.linspace(part.bottom, part.top, count)
            shear = part.shear_rigidity * (slope @ w - value @ theta)
            rows.append((z, value @ w, shear, -part.flexural_rigidity * (slope @ theta)))
        z, *fields = (np.concatenate(column) for column in zip(*rows, strict=True))
        deflection, shear, moment = (field.T for field in fields)
        return z, deflection, shear, moment


def _functions(degree: int, xi: Array, length: float) -> tuple[Array, Array]:
    """Return an element's functions of ξ from −1 to 1 and their slopes, shape (points, degree + 1).

    The first two are the straight lines that are 1 at one joint and 0 at the other; the others
    (P_{j+1} − P_{j−1})/√(4j + 2), of slope P_j √(j + ½) in ξ. Slopes are by height [1/m].
    """
    polynomials = legendre.legvander(xi, degree)
    j = np.arange(1, degree)
    inner = (polynomials[:, 2:] - polynomials[:, :-2]) / np.sqrt(4.0 * j + 2.0)
    value = np.column_stack((0.5 * (1.0 - xi), 0.5 * (1.0 + xi), inner))
    half = np.full(xi.shape, 0.5)
    slope = np.column_stack((-half, half, polynomials[:, 1:-1] * np.sqrt(j + 0.5)))
    return value, slope * (2.0 / length)
