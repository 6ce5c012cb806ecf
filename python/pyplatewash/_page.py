"""A page in three dimensions: in a notebook's cell, in a file, in the browser."""

from __future__ import annotations

import html
import os
import tempfile
import warnings
import webbrowser
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from . import _core
from ._errors import DynamicsError, SimulationError

#: Height of a cell that is not told otherwise [px].
HEIGHT = 640


@dataclass(frozen=True)
class Page:
    """A page in HTML that needs nothing else, no network either. A notebook shows it in the cell whose last line it is.

    >>> page = Page("<!doctype html><title>a page</title>")
    >>> page
    Page(1 kB)
    """

    #: The whole page.
    html: str = field(repr=False)
    #: How high a notebook shows it [px].
    height: int = HEIGHT

    def __post_init__(self) -> None:
        _core._check("page", self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the page to a file. Raises FileError."""
        _core._save(self.html, path)

    def open(self, path: str | os.PathLike[str] | None = None) -> Path:
        """Writes the page to a file, by default a new one in the system's folder for temporary files, and opens it in the browser.

        Gives the file, which stays. Where no browser can be started, a warning says so. A browser that is packed in a sandbox of its
        own may not see the system's temporary files: then give a ``path`` that it sees. Raises FileError.
        """
        file = Path(tempfile.mkdtemp(prefix="platewash-"), "page.html") if path is None else path
        self.save(file)
        file = Path(file).resolve()
        if not webbrowser.open(file.as_uri()):
            warnings.warn(f"no browser could be started; open {file} in one", stacklevel=2)
        return file

    def _repr_html_(self) -> str:
        """A frame that may run the page's script and nothing else: it has no access to the notebook."""
        return (
            f'<iframe title="platewash" sandbox="allow-scripts" allow="fullscreen" style="width:100%;height:{self.height}px;border:0"'
            f' srcdoc="{html.escape(self.html)}"></iframe>'
        )

    def __repr__(self) -> str:
        return f"Page({max(round(len(self.html) / 1e3), 1)} kB)"


#: Execution, certificate, scenario and arm, as they are given.
Beside = tuple[Any, Any, Any, Any]


def show(
    self: _core.Plan,
    execution: Any = None,
    certificate: Any = None,
    *,
    scenario: Any = None,
    robot: Any = None,
    prove: Any = True,
    simulate: Any = True,
    height: Any = HEIGHT,
) -> Page:
    """Shows the plan in three dimensions: a ``Page``, which a notebook shows in the cell and which can ``open()`` and ``save(path)``.

    As the command's ``view`` does, it proves the plan and simulates it with its own settings, unless a ``certificate`` or an
    ``execution`` is given or ``prove`` or ``simulate`` is False; what is not proved says so. A run of the paper's program has no
    certificate. Where the plan cannot be simulated, a warning says why.

    With ``scenario`` the page shows where its plates are drawn. ``robot`` is the arm, by default the one that the plan was made for.
    ``height`` is that of the cell [px].

    Raises MissingError in a build without the page; InputError for what does not belong to the plan; ProveError for a plan that says
    nothing that could be judged or whose arm must be given.
    """
    beside = (execution, certificate, scenario, robot)
    return _of_plan(self, beside, _core._show_arguments(self, beside, prove, simulate, height, None))


def view(
    self: _core.Plan,
    execution: Any = None,
    certificate: Any = None,
    *,
    scenario: Any = None,
    robot: Any = None,
    prove: Any = True,
    simulate: Any = True,
    path: Any = None,
) -> Path:
    """Writes the page of ``show`` to a file and opens it in the browser.

    Gives the file's path, by default that of a new one in the system's folder for temporary files, where it stays.

    Raises what ``show`` raises; FileError for a file that cannot be written. Where no browser can be started, a warning says so.
    """
    beside = (execution, certificate, scenario, robot)
    return _of_plan(self, beside, _core._show_arguments(self, beside, prove, simulate, None, path)).open(path)


def show_configuration(self: _core.Robot, q: Any, *, tool: Any = None, plates: Any = (), height: Any = HEIGHT) -> Page:
    """Shows one configuration, shape (6,), in three dimensions: a ``Page``, which a notebook shows in the cell.

    It can ``open()`` and ``save(path)``. With a tool and plates where they are given; nothing is judged. ``height`` is that of the
    cell [px].

    Raises MissingError in a build without the page.
    """
    return Page(*_core._configuration_page(self, q, tool, plates, height))


def _of_plan(plan: _core.Plan, beside: Beside, checked: tuple[tuple[_core.Robot, _core.Scenario | None], list[bool], int]) -> Page:
    (robot, scenario), (prove, simulate), height = checked
    execution, certificate = beside[:2]
    if certificate is None and prove and plan.process == "wash":
        certificate = _core.prove(plan, robot)
    if execution is None and simulate:
        try:
            execution = _core.simulate(plan, robot)
        except (DynamicsError, SimulationError) as error:
            warnings.warn(f"not simulated: {error}", stacklevel=3)
    return Page(_core._plan_page(plan, robot, execution, certificate, scenario), height)
