import dataclasses
import math

import pytest
from generated_collisions import collisions
from opensees_model import solve

from pierimpact import EquivalentPier, load_truck, simulate

try:
    import openseespy.opensees as ops
except (ImportError, RuntimeError):
    pytest.skip(
        "OpenSees does not load here: pip install openseespy; apt-get install libblas3 liblapack3",
        allow_module_level=True,
    )

STEP = 1e-5
# Friction against the pier acts only while spring 2 is in contact; OpenSees has no such element.
GENERATED = [case for case in collisions(24, seed=50) if case.truck.friction_on == "road"]


def peaks(history):
    return [history.engine_peak] + ([history.cargo_peak] if history.cargo_peak else [])


def errors(case, step):
    """Errors of OpenSees' peaks, relative, in a run until shortly after the last one."""
    history = simulate(*case)
    end = 1.02 * max(peak.time for peak in peaks(history)) + 1e-3
    found = solve(ops, *case, duration=end, step=step)
    assert math.isnan(found.cargo) == (history.cargo_peak is None)
    expected = [peak.reaction for peak in peaks(history)]
    return [abs(f / e - 1.0) for f, e in zip(found, expected, strict=False)]


@pytest.mark.parametrize("case", GENERATED)
def test_peaks_are_those_of_opensees(case):
    # Its steps run past every change of regime, by up to 5 mrad of the engine's oscillation.
    assert max(errors(case, STEP)) < 3e-4


@pytest.mark.parametrize("frequency", [5.0, 30.0, 90.0])
def test_opensees_comes_closer_in_shorter_steps(frequency):
    truck = dataclasses.replace(load_truck("single-unit-8t"), friction_force=0.0)
    pier = EquivalentPier(mass=8e3, stiffness=8e3 * (2.0 * math.pi * frequency) ** 2)
    coarse, fine = (max(errors((truck, pier, 80.0 / 3.6), step)) for step in (4e-5, 2e-6))
    assert fine < 0.2 * coarse
    assert fine < 1e-5
