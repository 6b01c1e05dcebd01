import dataclasses
import math

import numpy as np
import opensees_beam
import pytest
from generated_collisions import collisions
from opensees_model import solve
from test_beam_collision import struck_columns

from pierimpact import EquivalentPier, load_truck, simulate
from pierimpact.pier.beam import BeamPier

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


# The column of elastic Timoshenko elements.

DAMPING = 2e-5  # damping by stiffness [s]: 3 % of critical at 500 Hz, 16 % at 2500 Hz
COLUMNS = [s for s in struck_columns(18, seed=53) if s.truck.friction_on == "road"][:10]


class DampedByStiffness(BeamPier):
    """A beam of which every shape is damped in proportion to its stiffness."""

    @property
    def damping(self):
        return DAMPING * self.circular_frequencies**2


def errors_of_column(struck, elements, step):
    """Errors of OpenSees' largest displacement, shear and moment of the first 80 ms, relative."""
    undamped = struck.column.beam(struck.impact_height, 0.0)
    fields = {f.name: getattr(undamped, f.name) for f in dataclasses.fields(undamped)}
    history = simulate(struck.truck, DampedByStiffness(**fields), struck.speed)
    forces, displacement = history.member_forces, history.pier_displacement
    corners = [0, *np.flatnonzero(forces.z == struck.impact_height), len(forces.z) - 1]
    fields = [displacement[:, None], forces.shear[:, corners], forces.moment[:, corners]]
    sizes = [np.abs(field).max(axis=1) for field in fields]
    early = np.count_nonzero(history.time < 0.08)
    end = history.time[max(size[:early].argmax() for size in sizes)] + 1e-3
    within = history.time <= end
    found = opensees_beam.solve(
        ops,
        *(struck.truck, struck.column, struck.impact_height, struck.speed),
        damping=DAMPING,
        duration=end,
        elements=elements,
        step=step,
    )
    return [abs(f / size[within].max() - 1.0) for f, size in zip(found, sizes, strict=True)]


@pytest.mark.parametrize("struck", COLUMNS, ids=range(len(COLUMNS)))
def test_shear_and_moment_of_a_column_are_those_of_opensees(struck):
    # Errors are of the second order in elements and steps; the next test halves both. The shear
    # jumps most sharply, where wave fronts pass.
    displacement, shear, moment = errors_of_column(struck, elements=30, step=4e-5)
    assert max(displacement, moment) < 5e-3
    assert shear < 0.02


@pytest.mark.parametrize("struck", COLUMNS[:3], ids=range(3))
def test_opensees_comes_closer_with_shorter_elements_and_steps(struck):
    coarse, fine = (
        max(errors_of_column(struck, elements, step)) for elements, step in ((20, 6e-5), (40, 3e-5))
    )
    assert fine < 0.4 * coarse
