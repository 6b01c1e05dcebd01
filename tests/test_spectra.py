"""Spectra by three routes against the functions they gather."""

import math

import numpy as np
import pytest

from pierimpact import (
    InputError,
    cargo_spectrum,
    design_reactions,
    engine_spectrum,
    load_truck,
    peak_reactions,
)
from pierimpact.design.formulas import amplification
from pierimpact.design.reduction import exact_amplification
from pierimpact.design.spectra import FREQUENCIES

TRUCK = load_truck("single-unit-8t")
SPEED, MASS, ZETA = 22.2, 12e3, 0.04
FEW = np.geomspace(8.0, 150.0, 12)
SPECTRA = {"engine": engine_spectrum, "cargo": cargo_spectrum}


@pytest.mark.parametrize("level", ["refined", "hand"])
@pytest.mark.parametrize("which", SPECTRA)
def test_routes(which, level):
    found = SPECTRA[which](TRUCK, SPEED, MASS, ZETA, FEW, level)
    stiffness = MASS * (2.0 * np.pi * FEW) ** 2
    peaks = peak_reactions(TRUCK, MASS, stiffness, ZETA, SPEED)
    design = design_reactions(TRUCK, MASS, stiffness, ZETA, SPEED, level=level)
    np.testing.assert_array_equal(found.full_model, getattr(peaks, which))
    np.testing.assert_array_equal(found.closed_form, getattr(design, which))
    # All three tell of the same thing.
    for route in (found.closed_form, found.two_degrees):
        np.testing.assert_allclose(route / found.full_model, 1.0, atol=0.4)


def test_the_two_degrees_differ_from_the_hand_formula_by_the_amplification():
    found = engine_spectrum(TRUCK, SPEED, MASS, ZETA, FEW, "hand")
    shift, ratio = found.two_degrees / found.closed_form, found.exact / found.closed
    assert np.abs(ratio - 1.0).max() > 0.01
    assert (np.sign(shift - 1.0) == np.sign(ratio - 1.0)).all()


@pytest.mark.parametrize("which", SPECTRA)
def test_dimensionless_part(which):
    found = SPECTRA[which](TRUCK, SPEED, MASS, ZETA, FEW)
    mass, stiffness = (700.0, 150e6) if which == "engine" else (7300.0, 10e6)
    beta = FEW / (math.sqrt(stiffness / mass) / (2.0 * math.pi))
    e = math.sqrt(1.0 / 6.0)
    np.testing.assert_allclose(found.frequency_ratio, beta, rtol=1e-12)
    np.testing.assert_allclose(found.exact, exact_amplification(beta, mass / MASS, e, ZETA))
    np.testing.assert_allclose(found.closed, amplification(beta, mass / MASS, e, ZETA))
    np.testing.assert_array_equal(found.frequency, FEW)


def test_the_usual_frequencies():
    found = cargo_spectrum(TRUCK, SPEED, MASS)
    assert found.frequency is not None
    assert found.frequency.shape == FREQUENCIES.shape == found.closed_form.shape
    assert (found.frequency.min(), found.frequency.max()) == pytest.approx((2.0, 200.0))


def test_without_contact_there_is_no_cargo_spectrum():
    found = cargo_spectrum(TRUCK, 6.0, MASS, ZETA, FEW)
    for route in (found.full_model, found.two_degrees, found.closed_form):
        assert np.isnan(route).all()
    assert np.isfinite(found.exact).all()
    engine = engine_spectrum(TRUCK, 6.0, MASS, ZETA, FEW)
    assert np.isfinite(engine.full_model).all()


def test_a_stiff_pier_feels_the_engine_and_a_soft_one_the_cargo():
    soft, stiff = (
        {which: SPECTRA[which](TRUCK, SPEED, MASS, ZETA, [f]).full_model[0] for which in SPECTRA}
        for f in (8.0, 150.0)
    )
    assert soft["cargo"] > 2.0 * soft["engine"]
    assert stiff["engine"] > stiff["cargo"]


def test_one_frequency():
    found = engine_spectrum(TRUCK, SPEED, MASS, ZETA, 30.0)
    assert found.full_model.shape == found.closed.shape == (1,)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"speed": -1.0}, "speed must be positive, got -1"),
        ({"pier_mass": 0.0}, "pier_mass must be positive, got 0"),
        ({"damping_ratio": 1.0}, "damping_ratio must lie from 0 to below 1, got 1"),
        ({"frequency": [1.0, 0.0]}, "frequency must be positive, got 0 at index 1"),
        ({"level": "rough"}, "level must be one of refined, hand, got 'rough'"),
    ],
)
@pytest.mark.parametrize("which", SPECTRA)
def test_bad_input(which, changes, message):
    arguments = {"truck": TRUCK, "speed": SPEED, "pier_mass": MASS, "frequency": FEW}
    with pytest.raises(InputError, match=f"^{message}$"):
        SPECTRA[which](**(arguments | changes))
