"""What a collision with a beam looks like in time and over its height."""

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from pierimpact.collision.beam import ModalMotion
from pierimpact.collision.history import CollisionHistory, RecordedStep
from pierimpact.collision.series import TERMS, weights_of_all
from pierimpact.collision.stepping import PIER
from pierimpact.pier.beam import BeamPier
from pierimpact.pier.member_forces import MemberForceHistory

Array: TypeAlias = NDArray[np.float64]

# Samples of a step. Many shapes make the steps short, and the highest hardly take part.
FEWEST, MOST = 6, 24


@dataclass(frozen=True, kw_only=True)
class BeamCollisionHistory(CollisionHistory):
    """The motion of one collision with a beam, as `CollisionHistory`, with member forces.

    The pier's displacement is that of the beam at the nominal impact height, and the reaction the
    static force there that gives the same displacement.
    """

    beam: BeamPier
    #: of each step its motion, and the state that this applies to
    modal_steps: list[tuple[ModalMotion, Array]] = field(repr=False)

    @cached_property
    def member_forces(self) -> MemberForceHistory:
        """Shear and moment in time and over the height, their envelopes and extremes."""
        beam, (q, _) = self.beam, self.modal_coordinates
        return MemberForceHistory(
            time=self.time, z=beam.z, shear=q @ beam.shear, moment=q @ beam.moment
        )

    @cached_property
    def modal_coordinates(self) -> tuple[Array, Array]:
        """Modal coordinates q [m kg^½] and rates q' [m kg^½/s] of n shapes, shape (times, n)."""
        rows = self._modal(self._fractions)
        q, p = np.hsplit(np.vstack((rows[:, :-1].reshape(-1, rows.shape[-1]), rows[-1, -1])), 2)
        return q, p

    @cached_property
    def impulse(self) -> Array:
        """Impulse of the truck on the pier since first touch, ∫ F dt, shape (n,) [N s].

        From the beam's motion: the modal equations times φ/ω² add up to
        F/k_p = Σ φ (q''/ω² + 2 ζ q'/ω + q).
        """
        beam, (q, p) = self.beam, self.modal_coordinates
        shares = beam.impact_deflection / beam.circular_frequencies**2
        displacement = self._accumulate(self._series(PIER, order=-1))
        return self.pier.stiffness * (p @ shares + q @ (beam.damping * shares) + displacement)

    @cached_property
    def _fractions(self) -> Array:
        shapes = len(self.beam.circular_frequencies)
        return np.linspace(0.0, 1.0, 1 + max(FEWEST, math.ceil(MOST / shapes)))

    @property
    def _pieces(self) -> list[RecordedStep]:
        return self.steps

    @cached_property
    def _groups(self) -> list[tuple[ModalMotion, float, list[int], Array]]:
        """Steps alike: their motion, share of its step, numbers, and initial states in columns."""
        alike: dict[tuple[ModalMotion, float], list[int]] = {}
        for number, ((modal, _), (_, _, length)) in enumerate(
            zip(self.modal_steps, self.steps, strict=True)
        ):
            alike.setdefault((modal, length / modal.step), []).append(number)
        return [
            (*key, numbers, np.transpose([self.modal_steps[number][1] for number in numbers]))
            for key, numbers in alike.items()
        ]

    @cached_property
    def _terms(self) -> tuple[Array, ...]:
        terms = np.empty((3, len(self.steps), TERMS))
        for modal, share, numbers, states in self._groups:
            terms[:, numbers] = (modal.terms @ states).swapaxes(1, 2) * share ** np.arange(TERMS)
        return tuple(terms)

    def _modal(self, fractions: Array) -> Array:
        """Modal coordinates and their rates, shape (pieces, fractions, 2 × shapes)."""
        size = 2 * len(self.beam.circular_frequencies)
        rows = np.empty((len(self.steps), len(fractions), size))
        for modal, share, numbers, states in self._groups:
            if len(numbers) < len(fractions):  # their series cost less than the matrices
                terms = modal.coordinates @ (modal.powers @ states)
                values = np.tensordot(weights_of_all(share * fractions), terms, axes=(0, 0))
            else:
                matrices = [modal.propagator(share * fraction) for fraction in fractions]
                values = np.stack([modal.coordinates @ (matrix @ states) for matrix in matrices])
            rows[numbers] = np.moveaxis(values, -1, 0)
        return rows

    def _pier_energy(self) -> tuple[Array, Array]:
        q, p = self.modal_coordinates
        squares = (p**2, (self.beam.circular_frequencies * q) ** 2)
        kinetic, elastic = (0.5 * np.sum(square, axis=1) for square in squares)
        return kinetic, elastic

    def _damping_work(self) -> Array:
        def power(fractions: Array) -> Array:
            _, p = np.split(self._modal(fractions), 2, axis=-1)
            return np.asarray(p**2 @ self.beam.damping)

        return self._integrate(power)
