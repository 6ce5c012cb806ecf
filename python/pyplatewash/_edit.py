"""A live cell in a notebook, for which anywidget is asked only when one is made."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from . import _core
from ._errors import MissingError

if TYPE_CHECKING:
    from ._cell import Cell

MISSING = "a cell that is edited in a notebook needs anywidget, which is not installed: pip install 'pyplatewash[edit]'"


def edit(scenario: _core.Scenario | str | os.PathLike[str] = "kitchen", *, height: int = 720) -> Cell:
    """A scenario to change by hand: in a notebook, the last line of a cell shows it as a page in three dimensions with handles.

    Plates are dragged, keys are changed in a form or in the text; each change is planned and proved at once, by the kernel, which stays
    free meanwhile. ``cell.text``, ``cell.scenario``, ``cell.plan``, ``cell.certificate`` and ``cell.verdict`` follow what is done on the
    page, and ``cell.observe(f, names="plan")`` hears of it. Setting ``cell.text`` or ``cell.scenario`` changes the page.

    ``scenario`` is the name of a shipped one, a TOML file, whose comments are kept, or a Scenario. ``height`` is that of the page [px].

    Raises ScenarioError for what is no scenario; MissingError, an ImportError, without anywidget or in a build without the page.
    """
    try:
        from ._cell import Cell
    except ModuleNotFoundError as error:
        # Whatever else is missing is no affair of ours.
        if error.name is None or error.name.split(".")[0] not in ("anywidget", "ipywidgets", "traitlets"):
            raise
        raise MissingError(MISSING, name="anywidget") from error
    editor, height_px = _core._edit_arguments(scenario, height)
    return Cell(editor, height_px)
