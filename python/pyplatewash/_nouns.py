"""What the nouns of the core get from Python: a copy is the noun itself, notebooks show tables, plans and arms show pages."""

from __future__ import annotations

from typing import Any

from . import _core, _figure, _page, _tables

_TABLES: dict[type, Any] = {
    _core.Certificate: _tables.certificate,
    _core.Execution: _tables.execution,
    _core.Layout: _tables.layout,
    _core.PaperJob: _tables.job,
    _core.PaperRun: _tables.paper_run,
    _core.Plan: _tables.plan,
    _core.Planned: _tables.planned,
    _core.Robot: _tables.robot,
    _core.WashJob: _tables.job,
}
_WITHOUT_TABLE = (_core.ClearanceModel, _core.DynamicsModel, _core.Scenario, _core.SimulationSettings, _core.Trajectory)
#: Methods that Python's side of the package carries out.
_METHODS: tuple[tuple[type, str, Any], ...] = (
    (_core.Plan, "figure", _figure.figure),
    (_core.Plan, "show", _page.show),
    (_core.Plan, "view", _page.view),
    (_core.Robot, "show", _page.show_configuration),
)


def _copy(self: Any) -> Any:
    return self


def _deepcopy(self: Any, _memo: Any) -> Any:
    return self


def _shown_by(table: Any) -> Any:
    def _repr_html_(self: Any) -> str:
        text: str = table(self)
        return text

    return _repr_html_


def finish() -> None:
    """Gives the nouns what they share."""
    for noun in (*_TABLES, *_WITHOUT_TABLE):
        setattr(noun, "__copy__", _copy)
        setattr(noun, "__deepcopy__", _deepcopy)
    for noun, table in _TABLES.items():
        setattr(noun, "_repr_html_", _shown_by(table))
    for noun, name, method in _METHODS:
        method.__name__, method.__qualname__ = name, f"{noun.__name__}.{name}"
        setattr(noun, name, method)
