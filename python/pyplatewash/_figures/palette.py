"""Colours: those of Okabe and Ito, which colour-blind readers tell apart, and the source's magenta."""

from __future__ import annotations

#: The arm.
EXECUTED = "#1b1f24"
#: Rims of plates, and other outlines.
OUTLINE = "#6e7781"
#: A limit, a margin, what is missed.
LIMIT = "#d55e00"
#: Outcomes of rows, what is known to be impossible and what was not found well apart; and rows that ended in several ways.
OUTCOMES = {
    "proved": "#009e73", "not_proved": "#f0e442", "not_found": "#56b4e9", "infeasible": "#d55e00", "error": "#cc79a7", "crashed": "#1b1f24",
}  # fmt: skip
SEVERAL = "#8c959f"
#: Places where nothing is proved.
NOTHING = "#c8ccd1"
