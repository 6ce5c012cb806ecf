"""Pages, figures and tables: what they are made of, what they say, and that nothing in a file can make them say anything else."""

import json
import pickle
import re
import subprocess
import sys
import webbrowser
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

import pyplatewash as pw
from wheel_plans import paper_run, plan, planned

HOSTILE = "</script><script>alert(1)</script>\"'><img src=x onerror=alert(2)>&amp;שלום<!--" + 10_000 * "x"
VOID = {"meta", "img", "br", "hr", "input", "link"}


class Elements(HTMLParser):
    """The elements of a page with their attributes and the text within, and whether all are closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.texts: list[str] = []
        self.open: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))
        self.texts.append("")
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))
        self.texts.append("")

    def handle_endtag(self, tag: str) -> None:
        assert self.open and self.open.pop() == tag, tag

    def handle_data(self, data: str) -> None:
        if self.texts:
            self.texts[-1] += data

    def named(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.found if name == tag]


def document(page: pw.Page) -> dict[str, Any]:
    """What a page shows."""
    elements = Elements(page.html)
    shown = [text for (tag, attributes), text in zip(elements.found, elements.texts) if attributes.get("id") == "platewash-view"]
    assert len(shown) == 1
    found = json.loads(shown[0])
    assert isinstance(found, dict) and found["format"] == "platewash-view/2"
    return found


@pytest.fixture(scope="module")
def kitchen() -> pw.Plan:
    return plan("kitchen")


@pytest.fixture(scope="module")
def executed(kitchen: pw.Plan) -> pw.Execution:
    return pw.simulate(kitchen)


@pytest.fixture(scope="module")
def page(kitchen: pw.Plan) -> pw.Page:
    return kitchen.show()


@pytest.fixture(scope="module")
def paper() -> pw.PaperRun:
    return paper_run("paper-appendix")


def percent(share: float) -> str:
    """As reports round a share: down, to a tenth of a percent."""
    return f"{int(1000 * share + 1e-9) / 10:.1f} %"


@pytest.fixture(scope="module")
def hostile(kitchen: pw.Plan) -> pw.Plan:
    table = kitchen.to_dict()
    table["provenance"]["scenario"] = HOSTILE + "\u202e"
    with pytest.raises(pw.PlanFileError, match="provenance.scenario.*a control or direction character"):
        pw.Plan.from_json(json.dumps(table))
    table["provenance"]["scenario"] = HOSTILE
    return pw.Plan.from_json(json.dumps(table))


# Pages.


def test_a_page_needs_nothing_else(page: pw.Page) -> None:
    elements = Elements(page.html)
    policy = [m["content"] or "" for m in elements.named("meta") if (m.get("http-equiv") or "").lower() == "content-security-policy"]
    assert len(policy) == 1 and "default-src 'none'" in policy[0]
    for tag, attributes in elements.found:
        for name in {"src", "href", "data", "action", "srcset", "poster"} & attributes.keys():
            assert (attributes[name] or "").startswith(("data:", "#")), (tag, name, attributes[name])
        assert not any(name.startswith("on") for name in attributes), attributes
    styles = "".join(text for (tag, _), text in zip(elements.found, elements.texts) if tag == "style")
    assert styles and "@import" not in styles
    assert all(address.strip("'\"").startswith(("data:", "#")) for address in re.findall(r"url\(([^)]*)\)", styles))
    assert len(page.html) < 2.5e6


def test_a_cell_holds_the_page_in_a_sandbox(page: pw.Page) -> None:
    elements = Elements(page._repr_html_())
    [(tag, attributes)] = elements.found
    assert tag == "iframe" and not elements.open
    assert attributes["srcdoc"] == page.html
    assert attributes["sandbox"] == "allow-scripts"  # with allow-same-origin it could reach the notebook
    assert "height:640px" in (attributes["style"] or "")
    assert "height:300px" in pw.Page(page.html, 300)._repr_html_()
    assert "kB" in repr(page) and len(repr(page)) < 40
    assert pickle.loads(pickle.dumps(page)) == page


def test_show_proves_and_simulates_as_the_command_does(kitchen: pw.Plan, page: pw.Page) -> None:
    shown = document(page)
    assert shown["heading"]["hash"] == kitchen.hash and shown["heading"]["scenario"] == "kitchen"
    assert shown["certificate"]["passes"] is True and shown["certificate"]["headline"] == pw.prove(kitchen).headline
    assert shown["execution"]["law"] == "computed_torque" and shown["execution"]["headline"] == pw.simulate(kitchen).report().headline
    neither = document(kitchen.show(prove=False, simulate=False))
    assert neither["certificate"] is None and neither["execution"] is None
    circle = document(kitchen.show(prove=False, simulate=False, scenario="kitchen"))["surroundings"]["base_circle_m"]
    assert circle == pw.Scenario.load("kitchen").layout.base_radius_m


def test_shows_the_given_results(kitchen: pw.Plan) -> None:
    execution = pw.simulate(kitchen, settings=pw.SimulationSettings.of(kitchen).replace(law="pd_gravity"))
    shown = document(kitchen.show(execution, pw.prove(kitchen), prove=False, simulate=False))
    assert shown["execution"]["law"] == "pd_gravity" and shown["certificate"]["passes"] is True


def test_rejects_results_of_another_plan(kitchen: pw.Plan) -> None:
    other = plan("kitchen", 2)
    with pytest.raises(pw.InputError, match="certificate: is one of another plan"):
        kitchen.show(certificate=pw.prove(other))
    with pytest.raises(pw.InputError, match="execution: is one of another plan"):
        kitchen.show(pw.simulate(other))
    with pytest.raises(pw.InputError, match="execution: is one of another plan"):
        kitchen.figure("coverage", execution=pw.simulate(other))
    with pytest.raises(pw.InputError, match="certificate: is one of another plan"):
        kitchen.figure("coverage", certificate=pw.prove(other))


def test_a_broken_plan_looks_broken(kitchen: pw.Plan) -> None:
    table = kitchen.to_dict()
    table["knots"]["q_rad"][100][0] += 0.5
    changed = pw.Plan.from_json(json.dumps(table))
    shown = document(changed.show(simulate=False))
    assert shown["certificate"]["passes"] is False and shown["certificate"]["hash"] == "violated"
    assert "✗" in pw.prove(changed)._repr_html_() and "NOT that of the contents" in changed._repr_html_()


def test_a_run_of_the_papers_program_has_no_certificate(paper: pw.PaperRun) -> None:
    shown = document(paper.plan().show())
    assert shown["certificate"] is None and shown["heading"]["process"] == "paper"
    assert shown["execution"]["law"] == "paper" and shown["execution"]["washed"] is False


def test_an_arm_that_cannot_be_simulated_is_shown_all_the_same(kitchen: pw.Plan) -> None:
    massless = re.sub(r"<inertial>.*?</inertial>", "", pw.Robot.irb120().urdf, flags=re.DOTALL)
    robot = pw.Robot.from_urdf(massless, srdf=pw.Robot.irb120().srdf)
    table = kitchen.to_dict()
    table["job"]["workcell"]["arm"]["urdf_sha256"] = robot.sha256
    with pytest.warns(UserWarning, match="not simulated: .*mass"):
        shown = document(pw.Plan.from_json(json.dumps(table)).show(robot=robot))
    assert shown["execution"] is None and shown["certificate"] is not None


def test_a_page_is_saved_and_opened(page: pw.Page, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kitchen: pw.Plan) -> None:
    opened: list[str] = []

    def browse(address: str) -> bool:
        opened.append(address)
        return True

    monkeypatch.setattr(webbrowser, "open", browse)
    page.save(tmp_path / "saved.html")
    assert (tmp_path / "saved.html").read_text(encoding="utf-8") == page.html
    first, second = page.open(), page.open()
    assert first != second and first.read_text(encoding="utf-8") == page.html
    there = kitchen.view(simulate=False, path=tmp_path / "a b.html")
    assert there == (tmp_path / "a b.html").resolve() and document(pw.Page(there.read_text(encoding="utf-8")))["execution"] is None
    assert opened == [first.as_uri(), second.as_uri(), there.as_uri()] and there.as_uri().endswith("a%20b.html")
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    with pytest.warns(UserWarning, match=r"no browser could be started; open .*page\.html"):
        page.open()
    with pytest.raises(FileNotFoundError, match="cannot be written") as caught:
        page.save(tmp_path / "nowhere" / "page.html")
    assert isinstance(caught.value, pw.FileError) and caught.value.filename


def test_a_robot_shows_one_configuration() -> None:
    q = np.array([0.3, 0.2, -0.1, 0.4, 1.1, 0.0])
    robot, plates = pw.Robot.irb120(), [pw.Plate(x_m=0.3, y_m=0.1), pw.Plate(x_m=0.2, y_m=-0.3)]
    shown = document(robot.show(q, tool=pw.Tool(length_m=0.15), plates=plates, height=400))
    assert shown["heading"]["process"] is None and shown["motion"] is None and shown["certificate"] is None
    np.testing.assert_array_equal(shown["pose_rad"], q)
    assert shown["tool"]["tip"]["position_m"] == [0.0, 0.0, 0.15]
    assert [one["pose"]["position_m"][:2] for one in shown["plates"]] == [[0.3, 0.1], [0.2, -0.3]]
    assert document(robot.show(np.zeros(6)))["tool"] is None
    with pytest.raises(pw.InputError, match="q: is not finite"):
        robot.show([np.nan] * 6)
    with pytest.raises(pw.ShapeError):
        robot.show(np.zeros((2, 6)))


def test_escapes_a_name_that_is_html(hostile: pw.Plan, page: pw.Page) -> None:
    bad = hostile.show(simulate=False)
    assert document(bad)["heading"]["scenario"] == HOSTILE
    tags = [[tag for tag, _ in Elements(one.html).found] for one in (bad, page)]
    assert tags[0] == tags[1]
    [(tag, attributes)] = Elements(bad._repr_html_()).found
    assert tag == "iframe" and attributes["srcdoc"] == bad.html


# Figures.


def texts(figure: pw.Figure) -> list[str]:
    """What the texts of a figure say."""
    return ["".join(text.itertext()) for text in ElementTree.fromstring(figure.svg).iter("{http://www.w3.org/2000/svg}text")]


@pytest.mark.parametrize("kind", ["layout", "joints", "coverage", "spiral"])
def test_figures_are_those_of_the_command(kind: Any, kitchen: pw.Plan, executed: pw.Execution, tmp_path: Path) -> None:
    (tmp_path / "plan.json").write_text(kitchen.to_json())
    assert pw.run_command(["figures", str(tmp_path / "plan.json"), "--only", kind, "--out", str(tmp_path), "--quiet"]) == 0
    beside: dict[str, Any] = {} if kind == "joints" else {"execution": executed}
    figure = kitchen.figure(kind, certificate=pw.prove(kitchen), scenario="kitchen", **beside)
    assert figure.svg == (tmp_path / f"{kind}.svg").read_text(encoding="utf-8")
    assert figure._repr_svg_() == figure.svg and repr(figure).startswith("Figure(")
    figure.save(tmp_path / "own.svg")
    assert (tmp_path / "own.svg").read_text(encoding="utf-8") == figure.svg
    assert any("proved for every moment" in text for text in texts(figure))


def test_figures_state_missing_results(kitchen: pw.Plan) -> None:
    assert any(text.endswith("planned, not proved") for text in texts(kitchen.figure()))
    assert "base circle" not in kitchen.figure().svg and "base circle" in kitchen.figure(scenario="kitchen").svg
    assert any("Nothing was simulated." in text for text in texts(kitchen.figure("coverage")))
    assert "computed_torque" in kitchen.figure("spiral").svg  # It simulates.


def test_figures_of_the_papers_program(paper: pw.PaperRun) -> None:
    swept = pw.simulate(paper.plan())
    said = texts(paper.plan().figure("spiral", execution=swept))
    assert any("the paper's program" in text for text in said)
    for outcome in swept.report().plates:
        assert f"{percent(outcome.executed.lower)} swept" in said


def test_figures_of_hostile_names(hostile: pw.Plan) -> None:
    title = texts(hostile.figure())[0]
    assert len(title) < 90 and title.startswith('Layout: "</script>') and title.isprintable()


def test_figures_report_errors(kitchen: pw.Plan, root: Path) -> None:
    with pytest.raises(pw.InputError, match='kind: there is no figure "pie"; there are layout, joints, coverage, spiral'):
        kitchen.figure("pie")  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    other = pw.Robot.load(root / "crates/kinematics/tests/fixtures/ur5_lengths.urdf")
    with pytest.raises(pw.InputError, match="robot: the plan was made for another arm, 'irb120'"):
        kitchen.figure(robot=other)


def test_matplotlib_is_not_needed() -> None:
    code = "import sys, pyplatewash as pw; p = pw.plan(pw.Scenario.load('kitchen').job()).plan; p._repr_html_(); p.figure(); print('matplotlib' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


# Tables.


def order(plan: pw.Plan) -> str:
    """As words have it, counted from 1."""
    return ", ".join(str(index + 1) for index in plan.order)


def test_every_table_is_complete_and_matches_its_title(kitchen: pw.Plan, executed: pw.Execution, paper: pw.PaperRun) -> None:
    whole, certificate = planned("kitchen"), pw.prove(kitchen)
    nearest = next(check for check in certificate.checks if check.requirement == "clearance")
    nouns: list[tuple[Any, list[str]]] = [
        (kitchen, ["kitchen", f"{kitchen.duration_s:.2f} s", order(kitchen), (kitchen.hash or "")[:12], "as sealed", "see prove(plan)"]),
        (whole, [f"plate {visit.plate + 1}" for visit in whole.visits] + [f"{visit.wash_s:.2f} s" for visit in whole.visits]),
        (certificate, [certificate.headline, "✓ proved", "wash speed", " and ".join(nearest.worst.pair)]),
        (whole.job, ["kitchen", "irb120", "certified"]),
        (whole.job.layout, [f"({p.x_m:.4f}, {p.y_m:.4f}) m" for p in kitchen.plates]),
        (executed, [executed.report().headline, "computed_torque", "✓ washed"]),
        (paper, [percent(p.executed_coverage.fraction) for p in paper.report().plates]),
        (paper.job, ["paper-appendix", "the paper's"]),
        (paper.plan(), ["none for a run of the paper's program"]),
        (pw.Robot.irb120(), ["joint_1", "-165 to 165 °"]),
        (kitchen.job, ["requirements", "seed"]),
        (executed.report(), [executed.report().headline]),
    ]
    pictured = 0
    for noun, words in nouns:
        html = noun._repr_html_()
        elements = Elements(html)
        assert not elements.open and len(html) < 60_000, type(noun)
        text = "".join(elements.texts)
        for one in words:
            assert one in text, (type(noun), one)
        assert {tag for tag, _ in elements.found} <= {"div", "strong", "bdi", "table", "thead", "tbody", "tr", "th", "td", "svg", "circle", "path", "text", "pre", "span"}
        assert "#fff" not in html and "#000" not in html and "background" not in html  # It is read on light and on dark.
        pictured += bool(elements.named("svg"))
        assert noun._repr_html_() == html
    assert pictured == 7


def test_a_picture_shows_plates_and_paths(kitchen: pw.Plan) -> None:
    elements = Elements(kitchen._repr_html_())
    circles = [[float(c[key] or 0) for key in ("cx", "cy", "r")] for c in elements.named("circle")]
    np.testing.assert_allclose(circles, [(p.x_m, -p.y_m, p.radius_m) for p in kitchen.plates], atol=1e-4)
    paths = [p["d"] or "" for p in elements.named("path") if p["fill"] == "none"]
    assert len(paths) == 4
    for path, wash in zip(paths, kitchen.wash_paths):
        points = np.array([[float(v) for v in point.split()] for point in path.removeprefix("M").split("L")])
        plate = kitchen.plates[wash.plate]
        reach = np.linalg.norm(points * (1, -1) - (plate.x_m, plate.y_m), axis=1)
        assert reach.max() == pytest.approx(wash.curve.radius_m, abs=2e-3) and reach[0] == pytest.approx(wash.curve.get("rings", {"inner_m": 0.0})["inner_m"], abs=1e-3)


def test_tables_of_hostile_names(hostile: pw.Plan, kitchen: pw.Plan) -> None:
    certificate = pw.prove(hostile)
    for noun in (hostile, certificate, pw.simulate(hostile), hostile.provenance, hostile.job):
        elements = Elements(noun._repr_html_())
        assert not elements.open and not {"script", "img"} & {tag for tag, _ in elements.found}
        assert len(noun._repr_html_()) < 60_000
    assert "</script>" in "".join(Elements(hostile._repr_html_()).texts)


def test_a_table_of_many_plates_stays_small(kitchen: pw.Plan) -> None:
    table = kitchen.to_dict()
    table["job"]["plates"] *= 25
    table["order"] = list(range(100))
    html = pw.Plan.from_json(json.dumps(table))._repr_html_()
    assert len(html) < 60_000 and html.count("<circle") == 100


def test_an_unusable_file_shows_a_table(kitchen: pw.Plan) -> None:
    table = kitchen.to_dict()
    table["wash_paths"][0]["plate"] = 99
    table["wash_paths"][1]["curve"]["turns"] = -4.0
    html = pw.Plan.from_json(json.dumps(table))._repr_html_()
    assert "<svg" not in html and f"{kitchen.duration_s:.2f} s" in html
