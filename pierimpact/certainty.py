"""How certain a value is: one vocabulary for truck files, design codes and what is printed."""

from enum import StrEnum


class Certainty(StrEnum):
    """How certain a value is; each member is the word that files use."""

    CITED = "cited"  # in the source paper
    READ = "read"  # in the source named
    SECONDARY = "secondary"  # read in another work's citation of the source
    RECALLED = "recalled"  # from general knowledge, not looked up
    CALIBRATED = "calibrated"  # fitted to what the source names
    ASSUMED = "assumed"  # chosen for want of a source
    ILLUSTRATIVE = "illustrative"  # a plausible round number, for teaching

    @property
    def verified(self) -> bool:
        """Whether the value is cited in the source paper or was read in its source."""
        return self in (Certainty.CITED, Certainty.READ)

    @property
    def words(self) -> str:
        """As it prints beside a truck and its parameters."""
        return _WORDS.get(self, self.value)

    @property
    def standard_words(self) -> str:
        """As it prints beside a value of a design code."""
        return _STANDARD_WORDS.get(self, "unverified: check against the standard")


_WORDS = {
    Certainty.CITED: "cited in the source paper",
    Certainty.READ: "read in the source",
    Certainty.SECONDARY: "unverified: second-hand",
    Certainty.RECALLED: "unverified: from memory",
}
_STANDARD_WORDS = {
    Certainty.CITED: "cited in the source paper",
    Certainty.READ: "read in a public copy",
}
