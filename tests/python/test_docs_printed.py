"""What pages print under commands on the plan of the kitchen, and on the cell of the engineer's tutorial, is what the commands print."""

import re
import shlex
import subprocess

import pytest

#: The plan of a run, and the pages with commands on that of the kitchen.
PLAN = "out/plan.json"
PAGES = ["certificate.md", "recover.md", "robot-programs.md", "simulation.md"]


def blocks(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def commands(block):
    """The commands of a console block, without comments, each with the text below it."""
    for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
        command, _, text = part.partition("\n")
        yield re.sub(r"\s+#.*", "", command), text


def check(command, text, platewash, folder):
    """Runs a command, whose answer must begin with the text. Lines may be broken elsewhere, and `…` stands for whatever comes between."""
    program, *arguments = shlex.split(command)
    assert program == "platewash", command
    ran = subprocess.run([platewash, *arguments], cwd=folder, capture_output=True, text=True, check=False)
    parts = [re.escape(" ".join(part.split())) for part in text.split("…")]
    said = " ".join(f"{ran.stdout} {ran.stderr}".split())
    assert re.match(".*".join(parts), said), f"{command}\n{text}\n{ran.stdout}{ran.stderr}"


@pytest.fixture(scope="module")
def kitchen(platewash, tmp_path_factory):
    """A folder in which the kitchen was run."""
    folder = tmp_path_factory.mktemp("kitchen")
    subprocess.run([platewash, "run", "--scenario", "kitchen", "--quiet"], cwd=folder, check=True, capture_output=True)
    return folder


@pytest.mark.parametrize("name", PAGES)
def test_pages_show_what_is_printed(root, platewash, kitchen, name):
    found = [block for block in blocks(root / "docs" / name, "console") if PLAN in block]
    assert found, "no commands"
    for block in found:
        for command, text in commands(block):
            check(command, text, platewash, kitchen)


def test_the_readme_begins_the_report_as_it_begins(root, kitchen):
    (shown,) = blocks(root / "README.md", "text")
    assert (kitchen / "out" / "report.txt").read_text(encoding="utf-8").startswith(shown)


def test_the_engineers_tutorial_shows_what_is_printed(root, platewash, tmp_path):
    page = root / "docs" / "tutorial-engineer.md"
    (cell,) = [block for block in blocks(page, "toml") if "[layout]" in block]
    near = cell.replace("[0.60, 0.20]", "[0.30, 0.20]")
    assert near != cell
    file, program = tmp_path / "mycell.toml", tmp_path / "robot" / "mycell.mod"
    file.write_text(cell, encoding="utf-8")
    found = [both for block in blocks(page, "console") for both in commands(block)]
    assert len(found) == 8
    for command, text in found:
        if "--program" in command:
            # Somebody has edited it.
            program.write_text(program.read_text(encoding="utf-8").replace(",z5,", ",z10,"), encoding="utf-8")
        check(command, text, platewash, tmp_path)
        # Plate 2 is moved after the first run.
        file.write_text(near, encoding="utf-8")
