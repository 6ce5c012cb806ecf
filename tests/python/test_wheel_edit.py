"""Live cells in notebooks, without a browser: what a page asks, what it is told, and what the cell's traits say."""

import json
import queue
import re
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import comm
import pytest
import traitlets
from comm.base_comm import BaseComm
from jupyter_client.manager import start_new_kernel

import pyplatewash as pw
from pyplatewash._cell import Cell
from wheel_plans import plan

#: Longest that anything is waited for [s].
LONGEST_S = 300.0
KITCHEN = pw.Scenario.load("kitchen")
OUT_OF_REACH = {"key": "layout.positions_m", "value": [[0.9, 0.0]]}
NOT_THERE = {"key": "wash.turns", "value": -1.0}


class RecordedComm(BaseComm):
    """The way to a notebook, on which everything is kept."""

    def __init__(self, **keywords: Any) -> None:
        self.sent: queue.Queue[dict[str, Any]] = queue.Queue()
        super().__init__(**keywords)

    def publish_msg(self, msg_type: str, data: Any = None, metadata: Any = None, buffers: Any = None, **keys: Any) -> None:
        json.dumps(data)  # A notebook takes nothing else.
        self.sent.put({"type": msg_type, **(data or {})})


class Front:
    """A notebook's front end with the page of a cell, by the messages that `_cell.js` sends and gets."""

    def __init__(self, cell: Cell, view: str = "v1") -> None:
        self.cell, self.view = cell, view
        self.told: list[dict[str, Any]] = []
        self.taken = 0
        assert isinstance(cell.comm, RecordedComm)
        self.comm: RecordedComm = cell.comm

    def send(self, content: Any) -> None:
        self.comm.handle_msg({"content": {"data": {"method": "custom", "content": content}}, "buffers": []})

    def next(self, wanted: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        """The first message not asked for before that is wanted."""
        until = time.monotonic() + LONGEST_S
        while True:
            for at in range(self.taken, len(self.told)):
                if wanted(self.told[at]):
                    return self.told[at]
            message = self.comm.sent.get(timeout=until - time.monotonic())
            if message.get("method") == "custom":
                self.told.append(message["content"])

    def open(self) -> str:
        self.send({"view": self.view, "open": True})
        page = self.next(lambda told: told["view"] == self.view and "page" in told)["page"]
        assert isinstance(page, str)
        return page

    def ask(self, number: Any, *edits: dict[str, Any], want: str = "proof", text: str | None = None, path: str = "/cell", question: Any = None) -> None:
        usual = {"session": "sessionofthistest", "text": self.cell.text if text is None else text, "edits": list(edits), "want": want, "arm": None}
        self.send({"view": self.view, "platewash": number, "path": path, "question": usual if question is None else question})

    def lines(self, number: Any) -> list[dict[str, Any]]:
        """The answer to a question, to its end."""
        self.next(lambda told: told.get("say") == {"platewash": number, "end": True})
        said = [told["say"] for told in self.told if told["view"] == self.view and "say" in told]
        mine = [words for words in said if words["platewash"] == number]
        assert [words for words in mine if "end" in words] == [mine[-1]], "one end, and nothing behind it"
        return [json.loads(words["line"]) for words in mine[:-1]]

    def kinds(self, number: Any) -> list[str]:
        return [line["kind"] for line in self.lines(number)]


def wait(is_so: Callable[[], bool]) -> None:
    until = time.monotonic() + LONGEST_S
    while not is_so():
        assert time.monotonic() < until
        time.sleep(0.002)


def ours() -> list[threading.Thread]:
    return [thread for thread in threading.enumerate() if thread.name.startswith("platewash ")]


@pytest.fixture(autouse=True)
def _no_thread_stays(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setattr(comm, "create_comm", RecordedComm)
    yield
    wait(lambda: not ours())


@pytest.fixture
def front() -> Iterator[Front]:
    cell = pw.edit("kitchen")
    front = Front(cell)
    front.open()
    yield front
    cell.close()


def document(page: str) -> Any:
    """What a page is given to begin with."""
    [block] = re.findall(r'<script type="application/json" id="platewash-edit">(.*?)</script>', page, flags=re.DOTALL)
    return json.loads(block)


def state(cell: Cell) -> tuple[Any, ...]:
    return (cell.text, cell.scenario, cell.plan, cell.certificate, cell.verdict, cell.headline)


def test_a_cell_begins_with_its_scenario_and_nothing_planned(root: Path) -> None:
    cell = pw.edit("kitchen")
    assert cell.text == (root / "scenarios" / "kitchen.toml").read_text(encoding="utf-8")
    assert state(cell)[1:] == (KITCHEN, None, None, "", "") and cell.height == 720
    assert repr(cell) == "Cell('kitchen')" and not ours()
    given = document(Front(cell).open())
    assert (given["format"], given["channel"], given["file"], given["text"]) == ("platewash-edit/1", "frame", None, cell.text)
    cell.close()


def test_the_cell_returns_the_plan_of_the_page(front: Front) -> None:
    cell, seen = front.cell, []
    cell.observe(lambda change: seen.append((change["name"], threading.current_thread() is threading.main_thread(), *state(cell))))
    front.ask(1)
    assert front.kinds(1) == ["scenario", "cell", "preview", "plan", "proof"]
    wait(lambda: len(seen) == 4)
    assert {name for name, *_ in seen} == {"plan", "certificate", "verdict", "headline"}
    assert {(on_main, *rest[4:]) for _, on_main, *rest in seen} == {(False, "proved", cell.headline)}
    assert all(rest[:4] == [cell.text, KITCHEN, cell.plan, cell.certificate] for _, _, *rest in seen), "all of them, at once"
    assert cell.plan is not None and cell.plan == plan("kitchen") and cell.plan.hash == front.lines(1)[3]["heading"]["hash"]
    assert cell.certificate is not None and cell.certificate == pw.prove(cell.plan) and cell.headline == cell.certificate.headline


def test_a_change_keeps_comments_and_replans(front: Front) -> None:
    cell, heard = front.cell, queue.Queue[pw.Plan | None]()
    cell.observe(lambda change: heard.put(change["new"]), names="plan")
    before = cell.text
    front.ask("a", {"key": "layout.positions_m", "value": [[0.36, -0.11], [0.36, 0.21]]}, {"key": "seed", "value": 5})
    assert front.kinds("a")[-1] == "proof"
    planned = heard.get(timeout=LONGEST_S)
    assert planned is not None and planned == cell.plan == pw.plan(pw.Scenario.parse(cell.text, "kitchen").job()).plan
    assert cell.scenario.layout.positions_m == [[0.36, -0.11], [0.36, 0.21]] and cell.scenario.seed == 5 and cell.verdict == "proved"
    comments = [line for line in before.splitlines() if line.startswith("#")]
    assert comments and all(line in cell.text.splitlines() for line in comments) and cell.text != before


def test_a_newer_question_ends_an_older_one(front: Front) -> None:
    edits = [{"key": "seed", "value": seed} for seed in range(1, 21)]
    for number, edit in enumerate(edits):
        front.ask(number, edit)
    assert front.kinds(19)[-1] == "proof"
    ends = [front.kinds(number)[-1] for number in range(19)]
    assert set(ends[1:]) == {"superseded"} and ends[0] in ("superseded", "proof")
    wait(lambda: front.cell.scenario.seed == 20)
    assert front.cell.plan == plan("kitchen", 20)


def test_a_preview_does_not_cancel_planning(front: Front) -> None:
    before = state(front.cell)
    front.ask("guess", OUT_OF_REACH, want="preview")
    assert front.kinds("guess")[-1] in ("preview", "unplanned") and state(front.cell) == before
    front.ask("plan")
    front.ask("guess2", want="preview")
    assert front.kinds("guess2")[-1] == "preview" and front.kinds("plan")[-1] == "proof"


def test_a_plate_out_of_reach_leaves_no_plan(front: Front) -> None:
    front.ask(1)
    front.ask(2, OUT_OF_REACH)
    lines = front.lines(2)
    [line] = [line for line in lines if line["kind"] == "unplanned"]
    wait(lambda: front.cell.verdict == "unplanned")
    cell = front.cell
    assert (cell.plan, cell.certificate, cell.headline) == (None, None, line["headline"])
    assert cell.scenario.layout.positions_m == [[0.9, 0.0]]


def test_a_refused_change_has_no_effect(front: Front) -> None:
    cell = front.cell
    front.ask(1)
    front.lines(1)
    wait(lambda: cell.verdict == "proved")
    before = state(cell)[:4]
    for number, text in enumerate(["seed = 'x'", "[wash", "\x00", ""], 2):
        front.ask(number, text=text)
        assert front.kinds(number)[-1] == "refused"
    front.ask(9, NOT_THERE)
    refused = front.lines(9)[-1]
    assert refused["kind"] == "refused" and refused["key"] == "wash.turns"
    wait(lambda: cell.headline == refused["words"])
    assert cell.verdict == "refused" and state(cell)[:4] == before
    for number, question in enumerate([{"text": 3}, {"session": "sessionofthistest"}, {"session": "", "text": ""}], 10):
        front.ask(number, question=question)
        assert front.kinds(number) == ["failed"]
    for number, path in enumerate(["/save", "/disk", "/nothing"], 20):
        front.ask(number, path=path)
        assert front.kinds(number) == ["failed"]
    front.ask(30)
    assert front.kinds(30)[-1] == "proof"
    wait(lambda: cell.verdict == "proved")
    assert state(cell)[:4] == before


def test_a_question_can_be_cancelled(front: Front) -> None:
    before = state(front.cell)
    front.ask(1, {"key": "seed", "value": 7})
    front.send({"view": front.view, "platewash": 1, "abort": True})
    assert front.kinds(1)[-1] == "superseded"
    wait(lambda: not ours())
    assert state(front.cell) == before


def test_the_page_shows_values_set_in_python(front: Front) -> None:
    cell = front.cell
    front.ask(1)
    front.lines(1)
    wait(lambda: cell.verdict == "proved")
    heard: list[str] = []
    cell.observe(lambda change: heard.append(change["name"]))
    other = cell.text.replace("\nseed = 1", "\nseed = 2", 1)
    assert other != cell.text
    front.ask(2, {"key": "seed", "value": 9})  # Under way: nobody waits for it any more.
    cell.text = other
    assert state(cell) == (other, KITCHEN.replace(seed=2), None, None, "", "")
    assert set(heard) == {"text", "scenario", "plan", "certificate", "verdict", "headline"}
    assert front.next(lambda told: told.get("say", {}).get("platewash") == "take")["say"]["text"] == other
    assert front.kinds(2)[-1] == "superseded"
    wait(lambda: not ours())
    assert cell.text == other and cell.plan is None
    cell.scenario = KITCHEN.replace(seed=3)
    assert cell.text == KITCHEN.replace(seed=3).to_toml() and cell.scenario == pw.Scenario.parse(cell.text)
    assert front.next(lambda told: told.get("say", {}).get("text") == cell.text)
    front.ask(3)
    assert front.kinds(3)[-1] == "proof"
    wait(lambda: cell.verdict == "proved")
    assert cell.plan == plan("kitchen", 3)


def test_never_sets_an_invalid_scenario(front: Front) -> None:
    cell, before = front.cell, state(front.cell)
    for text in ("seed = 'x'", "[wash", "", "\x00", cell.text.replace("lift_m = 0.03", "lift_m = -1")):
        with pytest.raises(pw.ScenarioError):
            cell.text = text
    for name, wrong in [("text", 3), ("text", None), ("scenario", "kitchen"), ("plan", None), ("verdict", "proved")]:
        with pytest.raises(traitlets.TraitError):
            setattr(cell, name, wrong)
    assert state(cell) == before


def test_the_newer_of_two_pages_counts(front: Front) -> None:
    first, second = front, Front(front.cell, "v2")
    begun_with = first.cell.text
    first.ask(1, {"key": "seed", "value": 4})
    first.lines(1)
    wait(lambda: first.cell.scenario.seed == 4)
    assert document(second.open())["text"] == first.cell.text != begun_with
    before = state(front.cell)
    first.ask(2, {"key": "seed", "value": 8})
    second.ask(2, {"key": "seed", "value": 6})
    assert second.kinds(2)[-1] == "proof"
    wait(lambda: front.cell.scenario.seed == 6)
    assert before != state(front.cell)
    assert not [told for told in second.told if told["view"] == "v1" and told.get("say", {}).get("platewash") == 2]


def test_survives_any_message_of_a_page(front: Front, caplog: pytest.LogCaptureFixture) -> None:
    view = front.view
    hostile: list[Any] = [
        None, 3, [], "x", {}, {"view": 3}, {"view": "x" * 1000, "open": True}, {"view": view}, {"view": view, "open": "yes"},
        {"view": view, "platewash": {"a": [1]}, "abort": True}, {"view": view, "path": 3}, {"view": view, "path": "/cell"},
        {"view": view, "platewash": 1, "path": "/cell", "question": [[]]}, {"view": view, "platewash": None, "path": "\u2028", "question": {}},
    ]  # fmt: skip
    for content in hostile:
        front.send(content)
    front.ask("then")
    assert front.kinds("then")[-1] == "proof" and not caplog.records


def test_a_closed_cell_does_nothing() -> None:
    cell = pw.edit(KITCHEN)
    assert cell.text == KITCHEN.to_toml()
    front = Front(cell)
    front.open()
    for number, want in enumerate(["proof", "proof", "preview"]):
        front.ask(number, {"key": "seed", "value": 11}, want=want)
    front.ask("map", path="/map", question={"session": "sessionofthistest", "text": cell.text, "plate": 0})
    assert ours()
    cell.close()
    assert not ours() and state(cell)[:4] == (KITCHEN.to_toml(), pw.Scenario.parse(cell.text), None, None)
    kept = front.comm.sent.qsize()
    front.ask(9)
    assert not ours() and front.comm.sent.qsize() == kept
    cell.close()


def test_observers_may_fail_and_may_close_the_cell(front: Front, capfd: pytest.CaptureFixture[str]) -> None:
    cell = front.cell

    def fails(_change: Any) -> None:
        raise RuntimeError("an observer's own fault")

    cell.observe(fails, names="plan")
    front.ask(1)
    assert front.kinds(1)[-1] == "proof"
    wait(lambda: not ours())
    assert "an observer's own fault" in capfd.readouterr().err
    cell.unobserve(fails, names="plan")
    cell.observe(lambda _change: cell.close(), names="plan")
    front.ask(2, {"key": "seed", "value": 2})
    front.lines(2)
    wait(lambda: not ours())
    assert cell.comm is None and cell.plan == plan("kitchen", 2)


def test_a_scenarios_own_arm_goes_along(tmp_path: Path) -> None:
    arm = pw.Robot.irb120()
    (tmp_path / "own.urdf").write_text(arm.urdf + "<!-- mine -->")
    (tmp_path / "own.srdf").write_text(arm.srdf or "")
    text = KITCHEN.replace(layout={"count": 1}).to_toml()
    assert "[robot]\n" in text
    file = tmp_path / "cell.toml"
    file.write_text(re.sub(r"^model = .*\n", "", text, flags=re.MULTILINE).replace("[robot]\n", '[robot]\nurdf = "own.urdf"\nsrdf = "own.srdf"\n'))
    cell = pw.edit(file)
    front = Front(cell)
    front.open()
    front.ask(1)
    assert front.kinds(1)[-1] == "proof"
    wait(lambda: cell.verdict != "")
    assert cell.plan is not None and cell.plan.robot == pw.Robot.load(tmp_path / "own.urdf", srdf=tmp_path / "own.srdf") != arm
    assert pw.prove(cell.plan) == cell.certificate and cell.scenario.job().robot == cell.plan.robot
    cell.close()


def test_a_scenario_is_saved_whole_or_not_at_all(front: Front, tmp_path: Path) -> None:
    cell, place = front.cell, tmp_path / "kitchen ü.toml"
    cell.save(place)
    assert place.read_bytes() == cell.text.encode() and pw.Scenario.load(place) == cell.scenario.replace(name=pw.Scenario.load(place).name)
    place.write_text("old")
    place.chmod(0o640)
    (tmp_path / "link.toml").symlink_to(place)
    cell.save(str(tmp_path / "link.toml"))
    assert place.read_bytes() == cell.text.encode() and place.stat().st_mode & 0o777 == 0o640 and (tmp_path / "link.toml").is_symlink()
    with pytest.raises(pw.FileError, match="nowhere") as caught:
        cell.save(tmp_path / "nowhere" / "x.toml")
    assert isinstance(caught.value, FileNotFoundError) and isinstance(caught.value, pw.ScenarioError) and caught.value.errno == 2
    for wrong in (tmp_path, tmp_path / "a\x00b", place / "x.toml"):
        with pytest.raises(pw.FileError, match="cannot be written"):
            cell.save(wrong)
    with pytest.raises(pw.InputTypeError, match="path: a path is needed"):
        cell.save(3)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    assert {path.name for path in tmp_path.iterdir()} == {place.name, "link.toml"}


def test_rejects_cells_that_cannot_be_edited() -> None:
    for wrong, error in [("no-such-scenario", pw.ScenarioError), (3, pw.InputTypeError), (None, pw.InputTypeError), ([], pw.InputTypeError)]:
        with pytest.raises(error):
            pw.edit(wrong)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    for height in (10, 10**6, 3.5, "tall", True, None):
        with pytest.raises(pw.PlatewashError, match="height"):
            pw.edit("kitchen", height=height)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]


def test_without_anywidget_names_the_package_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in [name for name in sys.modules if name == "pyplatewash._cell" or name.split(".")[0] == "anywidget"]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, "anywidget", None)
    with pytest.raises(ImportError, match=r"pip install 'pyplatewash\[edit\]'") as caught:
        pw.edit("kitchen")
    assert isinstance(caught.value, pw.MissingError) and caught.value.name == "anywidget"


def test_the_front_end_uses_no_network_and_sandboxes_the_page() -> None:
    front_end = Path(pw.__file__).with_name("_cell.js").read_text(encoding="utf-8")
    shown: Any = pw.edit("kitchen")
    assert shown._esm == front_end
    shown.close()
    assert '"sandbox", "allow-scripts allow-downloads"' in front_end and not re.search(r"https?:|\bimport\b|innerHTML|eval\(", front_end)


def test_does_so_in_a_kernel(tmp_path: Path) -> None:
    manager, client = start_new_kernel(kernel_name="python3", cwd=str(tmp_path))
    try:
        client.execute("import pyplatewash as pw\ncell = pw.edit('kitchen')\ncell")
        opened, shown = None, None
        while shown is None:
            message = client.get_iopub_msg(timeout=LONGEST_S)
            assert message["msg_type"] != "error", message["content"]
            content = message["content"]
            if message["msg_type"] == "comm_open" and "_esm" in content["data"]["state"]:
                opened = content["comm_id"]
            if message["msg_type"] == "execute_result":
                shown = content["data"]
        assert shown["text/plain"] == "Cell('kitchen')"
        assert shown["application/vnd.jupyter.widget-view+json"]["model_id"] == opened

        def say(content: dict[str, Any]) -> None:
            data = {"method": "custom", "content": {"view": "v", **content}}
            message = client.session.msg("comm_msg", {"comm_id": opened, "data": data})
            client.shell_channel.send(message)

        say({"open": True})
        say({"platewash": 1, "path": "/cell", "question": {"session": "sessionofthistest", "text": KITCHEN.to_toml(), "edits": [], "want": "proof", "arm": None}})
        kinds: list[str] = []
        while True:
            message = client.get_iopub_msg(timeout=LONGEST_S)
            said = message["content"].get("data", {}).get("content", {}).get("say", {}) if message["msg_type"] == "comm_msg" else {}
            if "line" in said:
                kinds.append(json.loads(said["line"])["kind"])
            if "end" in said:
                break
        assert kinds == ["scenario", "cell", "preview", "plan", "proof"]
        outputs: list[str] = []
        code = "import time\nwhile not cell.verdict: time.sleep(0.01)\nprint(cell.verdict, cell.plan.hash)"
        reply = client.execute_interactive(code, timeout=LONGEST_S, output_hook=lambda said: outputs.append(said["content"].get("text", "")))
        assert reply["content"]["status"] == "ok"
        assert "".join(outputs).split() == ["proved", plan("kitchen").hash]
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=False)

