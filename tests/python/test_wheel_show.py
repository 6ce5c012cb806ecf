"""Pages, figures and tables: what they are made of, what they say, and that nothing in a file can make them say anything else."""

import json
import pickle
import re
import subprocess
import sys
import webbrowser
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.patches import Circle

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
    assert isinstance(found, dict) and found["format"] == "platewash-view/1"
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


@pytest.fixture(autouse=True)
def closed() -> Iterator[None]:
    yield
    plt.close("all")


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


def test_a_cell_holds_the_page_and_lets_it_do_nothing_but_run(page: pw.Page) -> None:
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


def test_what_is_given_is_shown(kitchen: pw.Plan) -> None:
    execution = pw.simulate(kitchen, settings=pw.SimulationSettings.of(kitchen).replace(law="pd_gravity"))
    shown = document(kitchen.show(execution, pw.prove(kitchen), prove=False, simulate=False))
    assert shown["execution"]["law"] == "pd_gravity" and shown["certificate"]["passes"] is True


def test_what_is_of_another_plan_is_refused(kitchen: pw.Plan) -> None:
    other = plan("kitchen", 2)
    with pytest.raises(pw.InputError, match="certificate: is one of another plan"):
        kitchen.show(certificate=pw.prove(other))
    with pytest.raises(pw.InputError, match="execution: is one of another plan"):
        kitchen.show(pw.simulate(other))
    with pytest.raises(pw.InputError, match="execution: is one of another plan"):
        kitchen.figure("tip", execution=pw.simulate(other))


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
    assert shown["heading"]["process"] == "configuration" and shown["motion"] is None and shown["certificate"] is None
    np.testing.assert_array_equal(shown["pose_rad"], q)
    assert shown["tool"]["tip"]["position_m"] == [0.0, 0.0, 0.15]
    assert [one["pose"]["position_m"][:2] for one in shown["plates"]] == [[0.3, 0.1], [0.2, -0.3]]
    assert document(robot.show(np.zeros(6)))["tool"] is None
    with pytest.raises(pw.InputError, match="q: is not finite"):
        robot.show([np.nan] * 6)
    with pytest.raises(pw.ShapeError):
        robot.show(np.zeros((2, 6)))


def test_a_name_that_is_html_is_text(hostile: pw.Plan, page: pw.Page) -> None:
    bad = hostile.show(simulate=False)
    assert document(bad)["heading"]["scenario"] == HOSTILE
    tags = [[tag for tag, _ in Elements(one.html).found] for one in (bad, page)]
    assert tags[0] == tags[1]
    [(tag, attributes)] = Elements(bad._repr_html_()).found
    assert tag == "iframe" and attributes["srcdoc"] == bad.html


# Figures.


def lines(ax: Axes, label: str) -> np.ndarray:
    """The points of the line of that label, without gaps."""
    [found] = [line for line in ax.lines if line.get_label() == label]
    points = np.column_stack([np.asarray(found.get_xdata(), float), np.asarray(found.get_ydata(), float)])
    finite: np.ndarray = points[np.isfinite(points).all(axis=1)]
    return finite


def legend(ax: Axes) -> list[str]:
    """What the legend of an axes or of its figure says."""
    own = ax.get_legend()
    found = [own] if own else ax.figure.legends
    assert len(found) == 1
    return [text.get_text() for text in found[0].get_texts()]


def tip_of(plan: pw.Plan, q: np.ndarray) -> np.ndarray:
    """The tip, by the package's own kinematics with the plan's tool."""
    tool = pw.Tool(length_m=plan.job.workcell.tool.tip.position_m[2])
    found: np.ndarray = pw.Robot.irb120().fk(q, tool=tool)[:, :3, 3]
    return found


def order(plan: pw.Plan) -> str:
    return ", ".join(map(str, plan.order))


def test_the_layout_is_the_plans(kitchen: pw.Plan) -> None:
    ax = kitchen.figure(scenario="kitchen")
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x [m]", "y [m]") and ax.get_aspect() == 1.0
    assert f'"kitchen", seed 1: 4 plates in {kitchen.duration_s:.1f} s' in ax.get_title()
    assert legend(ax) == ["between plates", "wash path", "base", "no plate centre within 280 mm", "region of plate centres"]
    circles = {(c.center, c.radius) for c in ax.patches if isinstance(c, Circle)}
    assert {((p.x_m, p.y_m), p.radius_m) for p in kitchen.plates} | {((0.0, 0.0), 0.28)} == circles
    assert [text.get_text() for text in ax.texts] == ["1", "2", "3", "4"]
    places = np.array([text.get_window_extent().get_points().mean(axis=0) for text in ax.texts])
    np.testing.assert_allclose(ax.transData.inverted().transform(places), [(kitchen.plates[k].x_m, kitchen.plates[k].y_m) for k in kitchen.order], atol=3e-3)
    washing = lines(ax, "wash path")
    for path in kitchen.wash_paths:  # The curve's points are on the line that is drawn.
        plate, curve = kitchen.plates[path.plate], path.curve.to_dict()
        rings = curve.pop("rings", None)
        ideal = pw.WashCurve(**curve, rings=rings and pw.Rings(**rings)).sample(1e-3)[1] + (plate.x_m, plate.y_m)
        assert max(np.linalg.norm(washing - point, axis=1).min() for point in ideal) < 2e-3
    home = tip_of(kitchen, np.atleast_2d(kitchen.trajectory.q_rad[0]))[0, :2]
    np.testing.assert_allclose(lines(ax, "between plates")[[0, -1]], [home, home], atol=1e-9)


def test_the_joints_are_shares_of_their_limits(kitchen: pw.Plan) -> None:
    axes = kitchen.figure("joints")
    assert [ax.get_ylabel() for ax in axes] == ["position [% of limit]", "speed [% of limit]", "acceleration [% of limit]"]
    assert axes[-1].get_xlabel() == "time [s]"
    assert legend(axes[0]) == [*(f"joint {k}" for k in range(1, 7)), "limit", "washing"]
    robot, motion = pw.Robot.irb120(), kitchen.trajectory
    extremes = motion.extremes()
    middle, half = (robot.upper + robot.lower) / 2, (robot.upper - robot.lower) / 2
    speed = extremes["speed_rad_s"].max(axis=0) / robot.velocity
    acceleration = extremes["acceleration_rad_s2"].max(axis=0) / kitchen.job.limits.joint_acceleration_rad_s2
    for joint in range(6):
        drawn = [lines(ax, f"joint {joint + 1}") for ax in axes]
        at_knots = drawn[0][np.isin(drawn[0][:, 0], motion.t_s), 1]
        np.testing.assert_allclose(at_knots, 100 * (motion.q_rad[:, joint] - middle[joint]) / half[joint], atol=1e-6)
        assert abs(drawn[1][:, 1]).max() == pytest.approx(100 * speed[joint], rel=1e-3, abs=1e-9)
        assert abs(drawn[2][:, 1]).max() == pytest.approx(100 * acceleration[joint], rel=1e-9, abs=1e-9)


def test_the_tip_keeps_below_its_limits(kitchen: pw.Plan, executed: pw.Execution) -> None:
    ax = kitchen.figure("tip", execution=executed)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("time [s]", "speed of the tip [m/s]")
    assert legend(ax) == ["planned", "executed", "limit", "limit while washing", "washing"]
    t_s, speed = lines(ax, "planned").T
    h = 1e-5
    inner = t_s[(t_s > h) & (t_s < kitchen.duration_s - h)][::50]
    moved = tip_of(kitchen, kitchen.trajectory.at(inner + h)[0]) - tip_of(kitchen, kitchen.trajectory.at(inner - h)[0])
    np.testing.assert_allclose(np.interp(inner, t_s, speed), np.linalg.norm(moved, axis=1) / (2 * h), atol=1e-4)
    bound = next(check.measure.bound for check in pw.prove(kitchen).checks if check.requirement == "tip_speed")
    assert 0.98 * bound < speed.max() <= bound


def test_the_clearance_is_that_of_the_certificate(kitchen: pw.Plan) -> None:
    ax = kitchen.figure("clearance")
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("time [s]", "least distance [mm]")
    check = next(check for check in pw.prove(kitchen).checks if check.requirement == "clearance")
    least = lines(ax, "planned")[:, 1].min()
    assert 1e3 * check.measure.bound <= least + 1e-6 and least == pytest.approx(1e3 * check.measure.seen, rel=0.05)
    assert any(all(body in words for body in check.worst.pair) for words in legend(ax))


def test_coverage_is_as_measured(paper: pw.PaperRun) -> None:
    spiral = plan("kitchen-spiral")
    axes = spiral.figure("coverage", execution=pw.simulate(spiral))
    assert [ax.get_title().split("\n")[0] for ax in axes] == [f"{k}: plate {plate}" for k, plate in enumerate(spiral.order, 1)]
    assert {ax.get_xlabel() for ax in axes} == {"x from its centre [mm]"} and not axes[0].figure.legends  # Nothing is missed.
    assert legend(paper.plan().figure("coverage")[0]) == ["never under the sponge"]
    report = paper.report()
    swept = pw.simulate(paper.plan())
    for ax, outcome in zip(paper.plan().figure("coverage", execution=swept), swept.report().plates):
        swept_cells, missed_cells = (np.ma.count(np.ma.asarray(image.get_array())) for image in ax.images)
        share = swept_cells / (swept_cells + missed_cells)
        of_report = next(p for p in report.plates if p.plate == outcome.plate)
        assert share == pytest.approx(of_report.executed_coverage.fraction, abs=0.02)
        assert f"{percent(outcome.executed.fraction)} swept, executed" in ax.get_title()


def test_a_spiral_is_drawn_beside_what_came_of_it(kitchen: pw.Plan, executed: pw.Execution) -> None:
    plate = kitchen.order[1]
    ax = kitchen.figure("spiral", plate=plate)
    assert isinstance(ax, Axes) and len(kitchen.figure("spiral")) == 4
    wash = next(s for s in kitchen.segments if s.kind == "wash" and s.plate == plate)
    rows = (executed.t_s >= wash.t_start_s) & (executed.t_s <= wash.t_end_s)
    centre = np.array([kitchen.plates[plate].x_m, kitchen.plates[plate].y_m])
    np.testing.assert_allclose(lines(ax, "executed (computed_torque)"), 1e3 * (tip_of(kitchen, executed.q_rad[rows])[:, :2] - centre), atol=1e-6)
    assert abs(np.linalg.norm(lines(ax, "planned"), axis=1).max() - 1e3 * kitchen.wash_paths[1].curve.radius_m) < 0.5
    off = next(s.tip_m for s in executed.report().segments if s.kind == "wash" and s.plate == plate)
    assert f"{1e3 * off.rms:.3g} mm rms" in ax.get_title() and f"{1e3 * off.max:.3g} mm at most" in ax.get_title()


KINDS = ["layout", "joints", "tip", "clearance", "coverage", "spiral"]


@pytest.mark.parametrize("kind", KINDS)
def test_the_callers_axes_are_drawn_on(kind: Any) -> None:
    kitchen = plan("kitchen-spiral")
    executed = pw.simulate(kitchen)
    new: Any = kitchen.figure(kind, execution=executed)
    count = len(new) if isinstance(new, list) else 1
    figure, grid = plt.subplots(1, count, squeeze=False)
    no_axes: Any = figure
    given: Any = list(grid.flat) if isinstance(new, list) else grid.flat[0]
    before = len(plt.get_fignums())
    found: Any = kitchen.figure(kind, given, execution=executed)
    assert found == given and len(plt.get_fignums()) == before
    assert all(ax.has_data() for ax in grid.flat) and not figure.legends
    assert [ax.get_legend() is not None for ax in grid.flat].count(True) == (kind != "coverage")
    for wrong in ([], [*grid.flat, grid.flat[0]]):
        with pytest.raises(pw.InputError, match=f"ax: as many Axes as this figure has are needed: {count}; found {len(wrong)}"):
            kitchen.figure(kind, wrong, execution=executed)
    with pytest.raises(pw.InputTypeError, match="ax: an Axes of matplotlib is needed"):
        kitchen.figure(kind, no_axes)
    with pytest.raises(pw.InputError, match="projection '3d'"):
        kitchen.figure(kind, count * [plt.figure().add_subplot(projection="3d")])


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_is_cut_off(kind: Any, kitchen: pw.Plan, paper: pw.PaperRun) -> None:
    for of in (kitchen, paper.plan()):
        drawn: Any = of.figure(kind, scenario=of.provenance.scenario)
        figure = (drawn[0] if isinstance(drawn, list) else drawn).figure
        figure.canvas.draw()
        whole, tight = figure.bbox, figure.get_tightbbox().transformed(figure.dpi_scale_trans)
        assert tight.x0 >= -1 and tight.y0 >= -1 and tight.x1 <= whole.x1 + 1 and tight.y1 <= whole.y1 + 1, (kind, tight, whole)


def test_figures_of_hostile_names(hostile: pw.Plan) -> None:
    title = hostile.figure().get_title()
    assert len(title) < 90 and title.startswith('"</script>') and title.isprintable()
    money = hostile.to_dict()
    money["provenance"]["scenario"] = "$\\frac{1$ _^"
    ax = pw.Plan.from_json(json.dumps(money)).figure("tip")
    ax.figure.canvas.draw()  # It is no formula.
    assert "$\\\\frac{1$" in ax.get_title()


def test_figures_say_what_is_wrong(kitchen: pw.Plan, root: Path) -> None:
    with pytest.raises(pw.InputError, match="kind: one of layout, joints, tip, clearance, coverage, spiral is needed; found 'pie'"):
        kitchen.figure("pie")  # type: ignore[call-overload]  # pyright: ignore[reportArgumentType, reportCallIssue]
    with pytest.raises(pw.InputError, match=f"plate: one of those that are washed is needed: {order(kitchen)}; found 7"):
        kitchen.figure("coverage", plate=7)
    other = pw.Robot.load(root / "crates/kinematics/tests/fixtures/ur5_lengths.urdf")
    with pytest.raises(pw.InputError, match="robot: the plan was made for another arm, 'irb120'"):
        kitchen.figure(robot=other)


def test_without_matplotlib_the_message_says_how_to_get_it(kitchen: pw.Plan, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(ImportError, match=r"pip install 'pyplatewash\[viz\]'") as caught:
        kitchen.figure()
    assert isinstance(caught.value, pw.MissingError) and caught.value.name == "matplotlib"
    again = pickle.loads(pickle.dumps(caught.value))
    assert (type(again), str(again), again.name) == (pw.MissingError, str(caught.value), "matplotlib")


def test_matplotlib_is_not_needed_otherwise() -> None:
    code = "import sys, pyplatewash as pw; p = pw.plan(pw.Scenario.load('kitchen').job()).plan; p._repr_html_(); print('matplotlib' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


# Tables.


def test_every_table_is_whole_and_says_what_its_noun_says(kitchen: pw.Plan, executed: pw.Execution, paper: pw.PaperRun) -> None:
    whole, certificate = planned("kitchen"), pw.prove(kitchen)
    nearest = next(check for check in certificate.checks if check.requirement == "clearance")
    nouns: list[tuple[Any, list[str]]] = [
        (kitchen, ["kitchen", f"{kitchen.duration_s:.2f} s", order(kitchen), (kitchen.hash or "")[:12], "as sealed", "see prove(plan)"]),
        (whole, [f"{visit.wash_s:.2f} s" for visit in whole.visits]),
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


def test_a_file_that_makes_no_picture_has_a_table(kitchen: pw.Plan) -> None:
    table = kitchen.to_dict()
    table["wash_paths"][0]["plate"] = 99
    table["wash_paths"][1]["curve"]["turns"] = -4.0
    html = pw.Plan.from_json(json.dumps(table))._repr_html_()
    assert "<svg" not in html and f"{kitchen.duration_s:.2f} s" in html
