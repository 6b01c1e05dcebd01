"""The calculation of a case: from the nominal impact height to reactions and member forces."""

from dataclasses import dataclass

from pierimpact.casefile import HIGH_IMPACT_HEIGHT, LOW_IMPACT_HEIGHT, Case
from pierimpact.collision import simulate
from pierimpact.column import StruckColumn
from pierimpact.history import CollisionHistory, Peak
from pierimpact.member_forces import MemberForces
from pierimpact.pier import EquivalentPier

#: A cargo peak below this share of the engine peak counts as "much smaller". The source paper
#: gives no figure; this one is this project's.
MUCH_SMALLER = 0.5


@dataclass(frozen=True, kw_only=True)
class Calculation:
    """A case, calculated.

    Parameters
    ----------
    case : Case
        What was asked.
    struck : StruckColumn
        The column under a unit force at the nominal impact height.
    pier : EquivalentPier
        The pier as one degree of freedom.
    history : CollisionHistory
        The collision.
    trial : CollisionHistory or None
        The collision at the lower nominal height, where the height was left to the rule.
    """

    case: Case
    struck: StruckColumn
    pier: EquivalentPier
    history: CollisionHistory
    trial: CollisionHistory | None

    @property
    def governing_peak(self) -> Peak:
        """The larger of engine and cargo peak."""
        return self.history.governing_peak

    @property
    def member_forces(self) -> MemberForces:
        """Member forces under the governing reaction as a static force."""
        return self.struck.member_forces(self.governing_peak.reaction)

    @property
    def utilisations(self) -> dict[str, float]:
        """Demand over resistance, "shear" and "moment", where the case gives a resistance [-]."""
        inputs, forces = self.case.inputs, self.member_forces
        demands = {
            "shear": (forces.largest_shear.value, inputs.shear_resistance),
            "moment": (forces.largest_moment.value, inputs.moment_resistance),
        }
        return {
            name: abs(demand) / resistance
            for name, (demand, resistance) in demands.items()
            if resistance is not None
        }


def calculate(case: Case) -> Calculation:
    """Calculate a case."""
    trial = None
    height = case.inputs.impact_height
    if height == "auto":
        trial = _collision(case, LOW_IMPACT_HEIGHT)[1]
        height = HIGH_IMPACT_HEIGHT if cargo_counts(trial) else LOW_IMPACT_HEIGHT
    pier, history = _collision(case, height)
    return Calculation(
        case=case, struck=case.column.struck_at(height), pier=pier, history=history, trial=trial
    )


def cargo_counts(history: CollisionHistory) -> bool:
    """Whether there is a cargo peak, and not one much smaller than the engine peak."""
    cargo = history.cargo_peak
    return cargo is not None and cargo.reaction >= MUCH_SMALLER * history.engine_peak.reaction


def _collision(case: Case, impact_height: float) -> tuple[EquivalentPier, CollisionHistory]:
    pier = case.column.equivalent(impact_height, case.inputs.damping_ratio)
    return pier, simulate(case.truck, pier, case.inputs.speed)
