"""A live cell: a scenario that a person changes on a page in a notebook, planned and proved at once.

The page stands in a frame that `_cell.js` makes. Its questions come through the kernel's messages, are answered on threads, line by
line, and what came of them are the traits of the cell. What page and planner say to each other is stated in
`crates/editor/src/protocol.rs`; what `_cell.js` says beside it stands at its head.
"""

from __future__ import annotations

import json
import os
import re
import threading
import traceback
from pathlib import Path
from typing import Any, TypeVar, cast

import anywidget
import traitlets

from . import _core
from ._errors import PlatewashError
from ._questions import Asked, Questions
from ._files import save_text

#: Longest name of a page.
LONGEST_VIEW = 64

_KIND = re.compile(r'\{"kind":"(\w+)"')


T = TypeVar("T")


def _outcome(kind: type[T]) -> traitlets.TraitType[T | None, T | None]:
    """A trait that is set here alone, and None where there is nothing."""
    trait: Any = traitlets.Instance(kind, allow_none=True, read_only=True)
    return cast("traitlets.TraitType[T | None, T | None]", trait)


class Cell(anywidget.AnyWidget, metaclass=traitlets.MetaHasTraits):
    """A scenario to change by hand, as ``edit`` makes it.

    ``text``, ``scenario``, ``plan`` and ``certificate`` always belong together: they are the last scenario that was planned on the page,
    and what came of it. They change together, once its plan is proved or there is none, on the thread that planned: observers hear of it
    there, see all of them changed, and the next plan waits for them. While something is dragged the page shows guesses and plans, of which
    the cell hears those that were proved. While the kernel runs a cell of the notebook, the page waits.
    """

    _esm: Any = Path(__file__).with_name("_cell.js")

    #: The scenario as TOML text, comments kept. Setting it changes the page; ScenarioError where it is no scenario.
    text = traitlets.Unicode()
    #: The same as an object. Setting it changes the page, and the text to that of ``to_toml``.
    scenario = traitlets.Instance(_core.Scenario)
    #: Its plan; None where there is none, or none yet.
    plan = _outcome(_core.Plan)
    #: What is proved about the plan; there wherever the plan is.
    certificate = _outcome(_core.Certificate)
    #: What came of what was last asked on the page: ``"proved"``, ``"not proved"`` (planned, and its certificate names what is not kept),
    #: ``"unplanned"``, ``"refused"`` (no scenario, or none that is planned here; the others are of the last one that was) or ``"failed"``;
    #: empty where nothing has been planned since the cell was made or its text set.
    verdict = traitlets.Unicode(read_only=True)
    #: The verdict in a sentence, with the reason.
    headline = traitlets.Unicode(read_only=True)
    #: How high the page is [px].
    height = traitlets.Int(720, min=100, max=10_000).tag(sync=True)

    def __init__(self, editor: _core.CellEditor, height: int) -> None:
        """Of an editor, as ``edit`` has it."""
        self._editor = editor
        self._questions = Questions(self._answer, self._give_up)
        #: The page that is shown; those shown before ask nothing any more.
        self._view = ""
        #: Guards the two below, and that traits are set together.
        self._lock = threading.RLock()
        #: What the traits hold by what was done on the page, or was set by the caller and told to the page.
        self._known = (editor.text, editor.parse(editor.text))
        #: How often the caller has set the scenario.
        self._changes = 0
        text, scenario = self._known
        super().__init__(height=height, text=text, scenario=scenario)
        self.on_msg(self._heard)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the scenario to a file, whole or not at all. Raises FileError."""
        save_text(path, self.text)

    def close(self) -> None:
        """Takes the page away and gives up what is being planned for it."""
        questions = self.__dict__.get("_questions")
        if questions is not None:
            questions.close()
        super().close()

    def __repr__(self) -> str:
        return f"Cell('{self.scenario.name}')"

    # What the caller sets.

    @traitlets.validate("text")
    def _read(self, proposal: Any) -> str:
        text = str(proposal["value"])
        if text != self._known[0]:
            self._editor.parse(text)
        return text

    @traitlets.observe("text", "scenario")
    def _set_by_the_caller(self, change: Any) -> None:
        is_text, new = change["name"] == "text", change["new"]
        with self._lock:
            if new == self._known[0 if is_text else 1]:
                return
            self._known = (new, self._editor.parse(new)) if is_text else (new.to_toml(), new)
            self._changes += 1
            changes = self._changes
        # Observers are called behind the lock: one may wait for another thread.
        with self.hold_trait_notifications(), self._lock:
            if changes == self._changes:
                self._put(None, None, "", "")
        self._questions.cancel()
        self._say(self._view, {"platewash": "take", "text": self._known[0]})

    def _put(self, plan: _core.Plan | None, certificate: _core.Certificate | None, verdict: str, headline: str) -> None:
        self.text, self.scenario = self._known
        self.set_trait("plan", plan)
        self.set_trait("certificate", certificate)
        self.set_trait("verdict", verdict)
        self.set_trait("headline", headline)

    # What the page says.

    def _heard(self, _cell: Any, content: Any, _buffers: Any) -> None:
        if not isinstance(content, dict):
            return
        view, number = content.get("view"), content.get("platewash")
        if not isinstance(view, str) or not 0 < len(view) <= LONGEST_VIEW:
            return
        if content.get("open") is True:
            self._open(view)
        elif view != self._view:
            return
        elif content.get("abort") is True:
            self._questions.cancel(lambda asked: asked.view == view and asked.number == number)
        elif isinstance(content.get("path"), str):
            self._ask(view, number, content["path"], content.get("question"))

    def _open(self, view: str) -> None:
        """Shows the page anew, as the scenario is now; those shown before are told by it."""
        self._view = view
        self._questions.cancel()
        try:
            page = self._editor.page(self.text)
        except PlatewashError as error:
            self.send({"view": view, "words": str(error)})
        else:
            self.send({"view": view, "page": page})

    def _ask(self, view: str, number: Any, path: str, question: Any) -> None:
        wants_guess = isinstance(question, dict) and question.get("want") == "preview"
        lane = "map" if path == "/map" else "preview" if wants_guess else "proof"
        asked = self._editor.ask(path, json.dumps(question))
        self._questions.ask(Asked(view, number, lane, self._changes, asked))

    # What it is told, on the threads.

    def _say(self, view: str, words: dict[str, Any]) -> None:
        if not self._questions.is_closed:
            self.send({"view": view, "say": words})

    def _give_up(self, asked: Asked) -> None:
        self._say(asked.view, {"platewash": asked.number, "line": '{"kind":"superseded"}'})
        self._say(asked.view, {"platewash": asked.number, "end": True})

    def _answer(self, asked: Asked) -> None:
        lines: dict[str, str] = {}

        def tell(line: str) -> bool:
            found = _KIND.match(line)
            lines[found[1] if found else ""] = line
            self._say(asked.view, {"platewash": asked.number, "line": line})
            return not self._questions.is_closed

        try:
            asked.question.answer(tell)
        except Exception as error:
            # A fault of ours: the page hears of it, and the next question is answered all the same.
            tell(json.dumps({"kind": "failed", "words": str(error)}, separators=(",", ":")))
        try:
            self._say(asked.view, {"platewash": asked.number, "end": True})
            if asked.lane == "proof":
                self._follow(asked, lines)
        except Exception:
            # An observer's: the page goes on without it.
            traceback.print_exc()

    def _follow(self, asked: Asked, lines: dict[str, str]) -> None:
        """Makes the traits what came of a question."""
        refused = next((kind for kind in ("refused", "failed") if kind in lines), None)
        if refused is None and not lines.keys() & {"proof", "unplanned"} or "superseded" in lines:
            return
        with self.hold_trait_notifications(), self._lock:
            if asked.changes != self._changes or self._questions.is_closed:
                return
            if refused is not None:
                self.set_trait("verdict", refused)
                self.set_trait("headline", str(json.loads(lines[refused])["words"]))
                return
            latest = self._editor.latest()
            if latest is None:
                return
            text, scenario, plan, certificate, headline = latest
            self._known = (text, scenario)
            verdict = "unplanned" if certificate is None else "proved" if certificate.proved else "not proved"
            self._put(plan, certificate, verdict, headline)
