"""How sure the member forces of a beam are: the sampled trucks of a band strike it."""

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.beams import LargestMemberForces, largest_member_forces
from pierimpact.collision.groups import join, repeat, select, single
from pierimpact.design.band import ReactionBand
from pierimpact.pier.beam import BeamPier

Array: TypeAlias = NDArray[np.float64]


class BeamBand(NamedTuple):
    """The largest shear and moment of a beam in many collisions."""

    nominal: LargestMemberForces  #: with every parameter at its value, floats
    sampled: LargestMemberForces  #: of the sampled trucks, arrays of shape (size,)

    def ratios(self, name: str) -> Array:
        """Return the largest "shear" or "moment" of each truck over the nominal one [-]."""
        found: Array = getattr(self.sampled, name) / getattr(self.nominal, name)
        return found


def beam_band(band: ReactionBand, beam: BeamPier, duration: float) -> BeamBand:
    """Return the member forces of a beam under the sampled trucks of a band.

    Parameters
    ----------
    band : ReactionBand
        Trucks and speeds.
    beam : BeamPier
        The pier that they strike.
    duration : float
        Time to follow them at most, as in `largest_member_forces` [s].

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
    >>> ratios = beam_band(band, beam, duration=0.3).ratios("moment")
    >>> np.quantile(ratios, (0.05, 0.95)).round(2)
    array([0.83, 1.36])
    """
    nominal = repeat(band.collision.parameters, 1)
    found = largest_member_forces(join(nominal, band.parameters), beam, duration)
    return BeamBand(single(found, 0), select(found, slice(1, None)))
