"""From section and material to the rigidities of the column and its mass per length."""

from pierimpact.handcalc import Calculation, Real
from pierimpact.pier.sections import Section


@Calculation
def flexure(E: Real, I: Real) -> dict[str, Real]:
    """The flexural rigidity of the gross section."""
    EI = E * I
    return locals()


@Calculation
def cracked_flexure(psi: Real, E: Real, I: Real) -> dict[str, Real]:
    """The flexural rigidity of which a share is effective."""
    EI = psi * E * I
    return locals()


@Calculation
def given_flexure(EIe: Real) -> dict[str, Real]:
    """The flexural rigidity where it is given."""
    EI = EIe
    return locals()


@Calculation
def shear(E: Real, nu: Real, A: Real, kappa: Real) -> dict[str, Real]:
    """The shear rigidity, of the gross section."""
    G = E / (2 * (1 + nu))
    GA = kappa * G * A
    return locals()


@Calculation
def mass(rho: Real, A: Real) -> dict[str, Real]:
    """The mass per length of one material."""
    mbar = rho * A
    return locals()


@Calculation
def composite_mass(rho: Real, Am: Real) -> dict[str, Real]:
    """The mass per length of two materials."""
    mbar = rho * Am
    return locals()


def rigidities(section: Section, *, cracked: bool, given: bool) -> tuple[Calculation, ...]:
    """Return the calculations of EI, of G and κGA, and of the mass per length.

    Parameters
    ----------
    section : Section
        The section.
    cracked, given : bool
        Whether a share ψ of EI is effective, or an effective EI is given.
    """
    return (
        given_flexure if given else cracked_flexure if cracked else flexure,
        shear,
        composite_mass if "Am" in section.values else mass,
    )
