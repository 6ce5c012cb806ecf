"""Answers: confirmed, not confirmed (where, and by how much), or not checked (why)."""

from dataclasses import dataclass

CONFIRMED, NOT_CONFIRMED, NOT_CHECKED = "confirmed", "not_confirmed", "not_checked"


@dataclass
class Answer:
    """Answer on one requirement of the certificate."""

    requirement: str
    status: str
    bound: float | None = None
    limit: float | None = None
    unit: str = ""
    words: str = ""

    def line(self):
        number = lambda x: "" if x is None else f"{x:.6g}"
        return (
            f"{self.requirement:<20} {self.status:<14} {number(self.bound):>12} {number(self.limit):>12} {self.unit:<7}"
            f" {self.words}"
        ).rstrip()


def judged(requirement, bound, limit, unit, words="", at_least=False):
    """Compares a bound with its limit. NaN confirms nothing."""
    kept = bound >= limit if at_least else bound <= limit
    return Answer(requirement, CONFIRMED if kept else NOT_CONFIRMED, float(bound), float(limit), unit, words)


def stated(requirement, faults):
    """A statement holds if nothing is at fault."""
    return Answer(requirement, NOT_CONFIRMED if faults else CONFIRMED, words="; ".join(faults))


def not_checked(requirement, why):
    return Answer(requirement, NOT_CHECKED, words=why)
