"""The study's file is what the study gives, and its coefficients are those in use."""

import json

import numpy as np
import pytest

from pierimpact import peak_reactions
from pierimpact.collision.groups import select
from pierimpact.collision.parameters import parameter_chunks
from pierimpact.collision.reactions import Reactions, full_model
from pierimpact.design import domain, procedure, study
from pierimpact.design.procedure import LEVELS
from pierimpact.design.reaction import predictions
from pierimpact.design.reduction import exact_amplification
from pierimpact.files.trucks import load_truck
from pierimpact.symbols import SYMBOLS


@pytest.fixture(scope="module")
def outcome():
    return json.loads(study.OUTCOME_FILE.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def spectrum(outcome):
    """Arguments and exact amplification of every case of the study."""
    arguments = study.spectrum_arguments(domain.sample(outcome["size"], outcome["seed"]))
    return arguments, exact_amplification(*arguments)


def test_the_file_is_of_this_domain_seed_and_size(outcome):
    assert (outcome["seed"], outcome["size"]) == (study.SEED, study.SIZE)
    assert outcome["size"] >= 5000
    names = {SYMBOLS[name].meaning: name for name in domain.DOMAIN}
    assert list(outcome["domain"]) == list(names)
    for name, text in outcome["domain"].items():
        low, high, unit, _ = domain.DOMAIN[names[name]]
        assert text == f"{low:g} to {high:g} {unit}"


def test_a_refit_gives_the_coefficients_in_use(outcome, spectrum):
    fitted = study.fit(*spectrum)
    used = {
        "height": procedure.RESONANCE,
        "end": procedure.RESONANCE_END,
        "decline": procedure.RESONANCE_DECLINE,
        "mass_effect": procedure.MASS_EFFECT,
        "damping_effect": procedure.DAMPING_EFFECT,
    }
    assert outcome["used"] == used
    for name, value in used.items():
        assert fitted[name] == pytest.approx(outcome["fitted"][name], rel=1e-4)
        decimals = len(str(value).partition(".")[2])
        assert round(fitted[name], decimals) == value


def test_a_refit_recovers_coefficients_it_does_not_know():
    arguments = study.spectrum_arguments(domain.sample(400, 9))
    beta, mu, e, zeta = arguments
    known = {"height": 1.2, "end": 2.5, "decline": 2.2, "mass_effect": 0.8, "damping_effect": 4.0}
    exact = procedure.combined(beta, mu, e, procedure.resonance(beta, mu, zeta, **known))
    assert study.fit(arguments, exact) == pytest.approx(known, rel=1e-4)


def test_the_fit_s_error_is_the_file_s(outcome, spectrum):
    arguments, exact = spectrum
    ratios = procedure.amplification(*arguments) / exact
    size = outcome["size"]
    for body, part in (("engine", slice(0, size)), ("cargo", slice(size, None))):
        found, stated = (
            study.summary(ratios[part]),
            outcome["closed over exact amplification"][body],
        )
        assert found == pytest.approx(stated, rel=1e-5)
        # Safe rather than not: little below, more above.
        assert found["1st percentile"] > 0.93
        assert found["coefficient of variation"] < 0.05


def test_the_first_cases_of_the_file_come_out_again(outcome):
    # The whole study takes long; a part of it must agree with the whole as a sample does.
    case = select(domain.sample(study.SIZE, study.SEED), slice(0, 600))
    exact = full_model(case)
    for level in LEVELS:
        predicted = predictions(case, level)
        for which in Reactions._fields:
            ratios = getattr(predicted, which) / getattr(exact, which)
            found = study.summary(ratios)
            stated = outcome["predicted over CMSD"][level][which]["all"]
            error = stated["coefficient of variation"] * stated["mean"] / np.sqrt(found["cases"])
            assert abs(found["mean"] - stated["mean"]) < 4.0 * error
            assert stated["smallest"] <= found["smallest"] * (1.0 + 1e-9)
            assert stated["largest"] >= found["largest"] * (1.0 - 1e-9)


def test_the_file_is_up_to_date(outcome):
    case = select(domain.sample(study.SIZE, study.SEED), slice(0, study.SHOWN))
    exact = full_model(case).governing
    for level in LEVELS:
        stated = outcome["governing of the first cases, predicted over CMSD"][level]
        found = predictions(case, level).governing / exact
        np.testing.assert_allclose(found, stated, rtol=1e-9)


def test_contact_speeds_of_the_file(outcome):
    case = select(domain.sample(study.SIZE, study.SEED), slice(0, 60))
    found, stated = (
        study.speed_errors(case),
        outcome["error of the contact speed over the truck's"],
    )
    for level in LEVELS:
        for body in ("engine", "cargo"):
            assert stated[level][body]["smallest"] <= found[level][body]["smallest"] + 1e-12
            assert stated[level][body]["largest"] >= found[level][body]["largest"] - 1e-12
            assert found[level][body]["cases"] > 40


def test_the_full_model_is_peak_reactions():
    truck = load_truck("single-unit-8t")
    stiffness, speed = np.array([284e6, 50e6, 2e9]), np.array([22.2, 6.0, 28.0])
    _, parts = parameter_chunks(truck, 8e3, stiffness, 0.05, speed)
    ((_, case),) = parts
    found, expected = full_model(case), peak_reactions(truck, 8e3, stiffness, 0.05, speed)
    np.testing.assert_array_equal(found.engine, expected.engine)
    np.testing.assert_array_equal(found.cargo, expected.cargo)
    np.testing.assert_array_equal(found.governing, expected.governing)


def test_another_truck_takes_the_place_of_the_sampled_ones():
    truck = load_truck("single-unit-8t").loaded_to(36e3)
    case = domain.sample(20, 0)
    changed = study.with_truck(case, truck)
    assert (changed.engine.mass + changed.body.mass == 36e3).all()
    assert (changed.body.stiffness == 10e6).all()
    assert not changed.on_pier.any()
    assert changed.pier_mass is case.pier_mass


def test_summary():
    ratios = np.array([1.0, np.nan, 1.2, 0.8, np.inf])
    found = study.summary(ratios)
    assert found["cases"] == 3
    assert found["mean"] == pytest.approx(1.0)
    assert found["coefficient of variation"] == pytest.approx(np.std([1.0, 1.2, 0.8]))
    assert (found["smallest"], found["largest"]) == (0.8, 1.2)
    ramp = study.summary(np.linspace(1.0, 2.0, 101))
    assert (ramp["1st percentile"], ramp["99th percentile"]) == pytest.approx((1.01, 1.99))
    assert ramp["coefficient of variation"] == pytest.approx(np.sqrt(0.085) / 1.5)  # var: (n²−1)/12
    assert study.summary(np.array([np.nan])) == {"cases": 0}


def test_bands_part_the_cases(outcome):
    case = domain.sample(300, 5)
    exact = full_model(case)
    found = study.assessment(case, exact, exact)
    for which in Reactions._fields:
        bands = dict(found[which])
        for level in LEVELS:
            assert list(outcome["predicted over CMSD"][level][which]) == list(bands)
        everything = bands.pop("all")
        assert sum(band["cases"] for band in bands.values()) == everything["cases"]
        assert everything["mean"] == 1.0


def test_main_writes_the_file_and_reports(tmp_path, monkeypatch):
    small = study.study(size=80, seed=3)
    monkeypatch.setattr(study, "OUTCOME_FILE", tmp_path / "study.json")
    monkeypatch.setattr(study, "study", lambda: small)
    lines = []
    study.main(report=lines.append)
    written = json.loads((tmp_path / "study.json").read_text(encoding="utf-8"))
    assert written["size"] == 80
    assert written["predicted over CMSD"] == small["predicted over CMSD"]
    assert len(lines) == 6
