"""The exercises of the teaching notebooks, a module for each lesson; answers are computed."""

from pierimpact.teaching.checker import Question
from pierimpact.teaching.questions import collision, design, limits, pier, reduction, spectra

#: The exercises of each lesson.
QUESTIONS: dict[str, tuple[Question, ...]] = {
    "collision": collision.QUESTIONS,
    "pier": pier.QUESTIONS,
    "reduction": reduction.QUESTIONS,
    "spectra": spectra.QUESTIONS,
    "design": design.QUESTIONS,
    "limits": limits.QUESTIONS,
}
