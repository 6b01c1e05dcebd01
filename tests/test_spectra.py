"""Spectra by three routes, each against an independent computation."""

import dataclasses
import functools
import math

import numpy as np
import pytest
import reference
import two_degrees
from calculator import Procedure, closed_spectrum
from generated_collisions import collisions

from pierimpact import (
    EquivalentPier,
    InputError,
    cargo_spectrum,
    engine_spectrum,
    load_truck,
    simulate,
)
from pierimpact.design.spectra import FREQUENCIES

TRUCK = load_truck("single-unit-8t")
SPEED, MASS, ZETA = 22.2, 12e3, 0.04
FEW = np.geomspace(8.0, 150.0, 12)
SPECTRA = {"engine": engine_spectrum, "cargo": cargo_spectrum}
CASES = collisions(8, seed=50)
solved = functools.cache(reference.solve)
integrated = functools.cache(two_degrees.amplification)


def spectrum_of(which, case, level="long"):
    """The spectrum of a generated collision, at its own frequency and at two others."""
    truck, pier, speed = case
    frequency = pier.frequency * np.array([0.5, 1.0, 2.0])
    return SPECTRA[which](truck, speed, pier.mass, pier.damping_ratio, frequency, level)


def each_collision(case):
    """The collisions that `spectrum_of` gathers."""
    for share in (0.5, 1.0, 2.0):
        pier = dataclasses.replace(case.pier, stiffness=case.pier.stiffness * share**2)
        yield case.truck, pier, case.speed


@pytest.mark.parametrize("which", SPECTRA)
def test_the_full_model_is_the_reference(which):
    for case in CASES:
        expected = [getattr(solved(*one), which) for one in each_collision(case)]
        np.testing.assert_allclose(spectrum_of(which, case).full_model, expected, rtol=1e-8)


@pytest.mark.parametrize("level", ["long", "short"])
@pytest.mark.parametrize("which", SPECTRA)
def test_the_closed_form_is_the_procedure_typed_again(which, level):
    for case in CASES:
        expected = [getattr(Procedure(*one, level), which) for one in each_collision(case)]
        found = spectrum_of(which, case, level).closed_form
        np.testing.assert_allclose(found, expected, rtol=1e-12)


@pytest.mark.parametrize("which", SPECTRA)
def test_the_two_degrees_are_an_independent_integration_in_the_short_level(which):
    for case in CASES[:4]:
        typed = [Procedure(*one, "short", integrated) for one in each_collision(case)]
        expected = [getattr(each, which) for each in typed]
        found = spectrum_of(which, case).two_degrees
        np.testing.assert_allclose(found, expected, rtol=1e-5)


@pytest.mark.parametrize("which", SPECTRA)
def test_dimensionless_part(which):
    found = SPECTRA[which](TRUCK, SPEED, MASS, ZETA, FEW)
    mass, stiffness = (700.0, 150e6) if which == "engine" else (7300.0, 10e6)
    beta = FEW / (math.sqrt(stiffness / mass) / (2.0 * math.pi))
    e = math.sqrt(1.0 / 6.0)
    np.testing.assert_allclose(found.frequency_ratio, beta, rtol=1e-12)
    for route, expected, rtol in (
        (found.closed, closed_spectrum, 1e-12),
        (found.exact, integrated, 1e-5),
    ):
        amplification = [expected(each, mass / MASS, e, ZETA) for each in beta]
        np.testing.assert_allclose(route, amplification, rtol=rtol)
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
    # Nor contact of the engine, of which there are the plateau peaks.
    pier = EquivalentPier.from_frequency(MASS, 30.0)
    assert simulate(TRUCK, pier, 3.0).engine_contact_time is None
    for speed in (3.0, 6.0):
        engine = engine_spectrum(TRUCK, speed, MASS, ZETA, FEW)
        for route in (engine.full_model, engine.two_degrees, engine.closed_form):
            assert np.isfinite(route).all()


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
        ({"frequency": [[1.0, 2.0]]}, r"frequency must be in one row, got shape \(1, 2\)"),
        ({"level": "rough"}, "level must be one of short, long, got 'rough'"),
        ({"level": []}, r"level must be one of short, long, got \[\]"),
    ],
)
@pytest.mark.parametrize("which", SPECTRA)
def test_bad_input(which, changes, message):
    arguments = {"truck": TRUCK, "speed": SPEED, "pier_mass": MASS, "frequency": FEW}
    with pytest.raises(InputError, match=f"^{message}$"):
        SPECTRA[which](**(arguments | changes))
