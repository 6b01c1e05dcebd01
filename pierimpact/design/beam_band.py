"""How sure the member forces of a beam are: the sampled trucks of a band strike it."""

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.beams import LargestMemberForces, largest_member_forces
from pierimpact.collision.groups import join, repeat, select, single
from pierimpact.collision.parameters import Parameters
from pierimpact.pier.beam import BeamPier

Array: TypeAlias = NDArray[np.float64]

# Numerical: time that all trucks are given, over that of the nominal one.
LONGER = 1.5


class BeamBand(NamedTuple):
    """The largest shear and moment of a beam in many collisions."""

    nominal: LargestMemberForces  #: with every parameter at its value, floats
    sampled: LargestMemberForces  #: of the sampled trucks, arrays of shape (size,)

    def ratios(self, name: str) -> Array:
        """Return the largest "shear" or "moment" of each truck over the nominal one [-]."""
        found: Array = getattr(self.sampled, name) / getattr(self.nominal, name)
        return found


def beam_band(
    nominal: Parameters, sampled: Parameters, beam: BeamPier, duration: float
) -> BeamBand:
    """Return the member forces of a beam under many trucks.

    Parameters
    ----------
    nominal : Parameters
        The collision with every parameter at its value, floats.
    sampled : Parameters
        Collisions of the sampled trucks, as in `ReactionBand`, arrays of shape (size,).
    beam : BeamPier
        The pier that they strike.
    duration : float
        Time that the nominal collision with it takes [s].

    Examples
    --------
    >>> import numpy as np
    >>> from pierimpact import CircularSection, PierColumn, load_truck, reaction_band
    >>> from pierimpact.design.beam_band import beam_band
    >>> column = PierColumn(
    ...     height=5.0, section=CircularSection(diameter=0.9), elastic_modulus=25e9, density=2400.0
    ... )
    >>> beam = column.beam(impact_height=1.2)
    >>> band = reaction_band(load_truck("single-unit-8t"), beam, speed=22.2, size=64)
    >>> found = beam_band(band.collision.parameters, band.parameters, beam, duration=0.2)
    >>> np.quantile(found.ratios("moment"), (0.05, 0.95)).round(2)
    array([0.83, 1.36])
    """
    trucks = join(repeat(nominal, 1), sampled)
    found = largest_member_forces(trucks, beam, LONGER * duration)
    return BeamBand(single(found, 0), select(found, slice(1, None)))
