import math

import pytest
from scipy.integrate import quad

from pierimpact import CircularSection, InputError, RectangularSection

CASES = [
    (CircularSection(diameter=0.914), 0.914, lambda y: 2.0 * math.sqrt(0.457**2 - y**2)),
    (RectangularSection(width=0.8, depth=1.3), 1.3, lambda y: 0.8),
]


def integral(function, low, high):
    value, _ = quad(function, low, high, epsabs=1e-13, epsrel=1e-11, limit=200)
    return value


@pytest.mark.parametrize(("section", "depth", "width_at"), CASES)
def test_properties_are_the_integrals_over_the_section(section, depth, width_at):
    low, high = -depth / 2.0, depth / 2.0
    assert section.area == pytest.approx(integral(width_at, low, high), rel=1e-9)
    second_moment = integral(lambda y: width_at(y) * y**2, low, high)
    assert section.second_moment == pytest.approx(second_moment, rel=1e-9)


@pytest.mark.parametrize(("section", "depth", "width_at"), CASES)
def test_default_shear_coefficient_follows_from_the_shear_stress_energy(section, depth, width_at):
    # Shear stress V S(y) / (I b(y)); its energy equals that of V on κA.
    def first_moment(y):
        return integral(lambda w: width_at(w) * w, y, depth / 2.0)

    energy = integral(lambda y: first_moment(y) ** 2 / width_at(y), 0.0, 0.4999999 * depth)
    coefficient = section.second_moment**2 / (section.area * 2.0 * energy)
    assert section.shear_coefficient == pytest.approx(coefficient, rel=1e-6)


def test_shear_coefficient_can_be_given():
    assert CircularSection(diameter=2.0, shear_coefficient=0.86).shear_coefficient == 0.86


@pytest.mark.parametrize(
    ("section", "arguments", "message"),
    [
        (CircularSection, {"diameter": 0.0}, "diameter must be positive, got 0"),
        (CircularSection, {"diameter": "wide"}, "diameter must be a number, got 'wide'"),
        (RectangularSection, {"width": -1.0, "depth": 1.0}, "width must be positive, got -1"),
        (RectangularSection, {"width": 1.0, "depth": math.inf}, "depth must be finite, got inf"),
        (
            CircularSection,
            {"diameter": 1.0, "shear_coefficient": 1.1},
            r"shear_coefficient must be at most 1, got 1\.1",
        ),
        (
            RectangularSection,
            {"width": 1.0, "depth": 1.0, "shear_coefficient": 0.0},
            "shear_coefficient must be positive, got 0",
        ),
    ],
)
def test_bad_values_are_named(section, arguments, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        section(**arguments)
