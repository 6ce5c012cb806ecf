"""Makes docs/arms.md: what `platewash run --urdf ARM` does with descriptions of arms that you fetch and expand with xacro.

    cargo build --release
    cargo xtask test --only browser     # once: fetches the browser into target/browser
    export ROS_PACKAGE_PATH=…           # the folders with the packages of the descriptions
    python docs/pictures/arms.py target/release/platewash FOLDER [NAME ...]

FOLDER holds an expanded NAME.urdf for each arm of the list below. Results are kept in target/arms, so that single arms can be done again by
name. Pictures are of the command's page, in the browser of the tests; Pillow is needed (matplotlib brings it along).
"""

import argparse
import json
import math
import re
import shutil
import subprocess
import time
from pathlib import Path

from make import HERE, frames_of

KEPT = HERE.parents[1] / "target" / "arms"

MOTOMAN, KUKA, FANUC = ("ros-industrial/" + name for name in ("motoman", "kuka_experimental", "fanuc"))
UR = ("UniversalRobots/Universal_Robots_ROS2_Description", "urdf/ur.urdf.xacro")
XARM = ("xArm-Developer/xarm_ros2", "xarm_description/urdf/xarm_device.urdf.xacro")
STAUBLI = "ros-industrial/staubli"

# By file name: the arm, the repository and the file of its description, the arguments of xacro, and further options of the command.
ARMS = {
    "ur3e": ("Universal Robots UR3e", *UR, "name:=ur3e ur_type:=ur3e", ""),
    "ur5e": ("Universal Robots UR5e", *UR, "name:=ur5e ur_type:=ur5e", ""),
    "ur10e": ("Universal Robots UR10e", *UR, "name:=ur10e ur_type:=ur10e", ""),
    "kr3r540": ("KUKA KR 3 R540", KUKA, "kuka_kr3_support/urdf/kr3r540.xacro", "", ""),
    "kr5_arc": ("KUKA KR 5 arc", KUKA, "kuka_kr5_support/urdf/kr5_arc.xacro", "", ""),
    "kr6r900": ("KUKA KR 6 R900 sixx", KUKA, "kuka_kr6_support/urdf/kr6r900sixx.xacro", "", ""),
    "kr10r900_2": ("KUKA KR 10 R900-2", KUKA, "kuka_kr10_support/urdf/kr10r900_2.xacro", "", ""),
    "lrmate200id": ("FANUC LR Mate 200iD", FANUC, "fanuc_lrmate200id_support/urdf/lrmate200id.xacro", "", ""),
    "m10ia": ("FANUC M-10iA", FANUC, "fanuc_m10ia_support/urdf/m10ia.xacro", "", ""),
    "irb2400": ("ABB IRB 2400", "ros-industrial/abb", "abb_irb2400_support/urdf/irb2400.xacro", "", ""),
    "rx160": ("Stäubli RX160", STAUBLI, "staubli_rx160_support/urdf/rx160.xacro", "", ""),
    "tx60": ("Stäubli TX60", f"{STAUBLI}_experimental", "staubli_tx60_support/urdf/tx60.xacro", "", ""),
    "mh5": ("Yaskawa Motoman MH5", MOTOMAN, "motoman_mh5_support/urdf/mh5.xacro", "", ""),
    "gp7": ("Yaskawa Motoman GP7", MOTOMAN, "motoman_gp7_support/urdf/gp7.xacro", "", ""),
    "hc10": ("Yaskawa Motoman HC10", MOTOMAN, "motoman_hc10_support/urdf/hc10.xacro", "", ""),
    "gen3": ("Kinova Gen3, 6 joints", "Kinovarobotics/ros2_kortex", "kortex_description/robots/gen3.xacro", "dof:=6", ""),
    "xarm6": ("UFACTORY xArm 6", *XARM, "robot_type:=xarm dof:=6", ""),
    "lite6": ("UFACTORY Lite 6", *XARM, "robot_type:=lite dof:=6", ""),
    "vs060": (
        "DENSO VS-060", "DENSORobot/denso_robot_ros2", "denso_robot_descriptions/urdf/denso_robot.urdf.xacro", "model:=vs060", "",
    ),
    "m0609": (
        "Doosan M0609", "doosan-robotics/doosan-robot2", "dsr_description2/xacro/m0609.urdf.xacro", "",
        "--tool-mount link6:z --visual-shapes",
    ),
}  # fmt: skip

TEXT = """# Arms

Descriptions of arms by their makers and by ROS-Industrial, each washed by one command without a scenario:

    platewash run --urdf NAME.urdf

The command looks for a home and a region in which the arm washes plates, plans, proves and simulates. No description is part of this
project: fetch the repository, expand the file with `xacro FILE ARGUMENTS -o NAME.urdf`, and name the folders of the packages in
`ROS_PACKAGE_PATH`. `docs/pictures/arms.py` makes this page and its pictures; it was run on {date}, seed 1, on two cores.

The kitchen's tool (150 mm, sponge of 25 mm radius) and plates (145 mm radius, 30 mm high) are the same for all arms, large or small. Each
proof rests on the assumptions that the report lists: above all that the description is that of the real arm, and that its joints reach the
accelerations assumed, which no description states. Links count as the convex hulls of their collision meshes unless the last column says
otherwise.

- **Inverse kinematics**: closed form, or a search. A search can miss a way: "not found" is not "impossible" then.
- **Region**: distances from axis 1 and angles between which plates are placed. An estimate from some places; only the plan is proved.
- **Clearance**: the least distance proved, at all times, of all pairs; 10 mm are required. Pairs with a smaller one of their own are in the last
  column.
- **Simulated**: whether the simulated arm washes, too, with the masses and the torques of the description. "Not washed": they do not carry the
  arm along the plan (some descriptions state placeholders). "Not simulated": a link states no mass.

| arm | tool on | inverse kinematics | region | plates, cycle | clearance | simulated | command | notes |
| --- | --- | --- | --- | --- | ---: | --- | ---: | --- |
{rows}

{refused}## Pictures

{pictures}

## Sources

| name | repository | file | arguments |
| --- | --- | --- | --- |
{sources}
"""


def platewash(command, *arguments):
    """Runs the command; returns its exit code, JSON, messages and seconds."""
    begun = time.monotonic()
    ran = subprocess.run([command, *map(str, arguments)], capture_output=True, text=True, check=False)
    return ran.returncode, ran.stdout, ran.stderr, time.monotonic() - begun


def measure(command, folder, name):
    """Washes with one arm, and keeps what is told of it."""
    *_, options = ARMS[name]
    given = ["--urdf", folder / f"{name}.urdf", *options.split()]
    out = KEPT / name
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    code, text, messages, seconds = platewash(command, "run", *given, "--json", "--out", out)
    shown = json.loads(platewash(command, "robot", *given, "--json", "--quiet")[1] or "{}")
    result = {"code": code, "seconds": seconds, "messages": messages, "robot": shown, "text": text}
    (KEPT / f"{name}.json").write_text(json.dumps(result))
    (out / "executed.csv").unlink(missing_ok=True)
    print(f"{name}: exit code {code} after {seconds:.1f} s", flush=True)


def picture(name, target):
    """Takes the picture of the arm in the middle of its first wash."""
    from PIL import Image

    page = KEPT / name / "page.html"
    if not page.exists():
        return
    frames_of(page, KEPT / name, 8)
    with Image.open(KEPT / name / "frame-001.png") as frame:
        wide = frame.convert("RGB")
        edge = min(wide.width, round(wide.height * 4 / 3))
        left = (wide.width - edge) // 2
        wide.crop((left, 0, left + edge, wide.height)).resize((360, 270), Image.Resampling.LANCZOS).save(
            target / f"{name}.jpg", quality=72
        )


def number(pattern, text):
    found = re.search(pattern, text)
    return json.loads(found[1]) if found else None


def millimetres(bound_m):
    """Formats a proved distance in tenths of a millimetre, rounded down."""
    return f"{math.floor(1e4 * bound_m) / 10:.1f}"


def row(name, result):
    """The line of an arm that is proved."""
    answer, robot = json.loads(result["text"]), result["robot"]
    certificate = answer["certificate"]
    bounds = {check["requirement"]: check for check in certificate["checks"]}
    least = bounds["clearance"]
    pair = " – ".join(least["worst"]["pair"])
    near, far = number(r"rho_m = (\[.*\])", result["messages"])
    start, end = number(r"azimuth_deg = (\[.*\])", result["messages"])
    mount, inverse = robot["tool_mount"], robot["inverse_kinematics"]
    reason = inverse.get("reason")
    notes = [
        f"{' – '.join(line['pair'])}: {millimetres(line['at_least_m'])} mm proved, {1e3 * line['required_m']:.1f} required"
        for line in certificate["clearance"]
        if line["rule"] == "reduced"
    ]
    own = ("without collision shapes", "no collision shapes", "convex parts")
    notes += [text for text in certificate["rests_on"]["assumptions"] if any(word in text for word in own)]
    arm, *_, options = ARMS[name]
    notes += [f"`{options}`"] if options else []
    closed = "search: " + re.sub(r"(\.\d)\d{3} mm", r"\1 mm", str(reason))
    if inverse["closed_form"]:
        closed = "closed form, up to rounding" if reason else "closed form"
    simulated = answer.get("simulation") or {}
    washed = simulated.get("verdict", "not simulated").replace("_", " ")
    return [
        arm,
        f"`{mount['link']}`, {mount['axis']}",
        closed,
        f"{near:g} to {far:g} m, {start:g} to {end:g}°".replace("-", "−"),
        f"{len(certificate['rests_on']['plates'])} in {certificate['duration_s']:.1f} s",
        f"{millimetres(least['measure']['bound'])} mm ({pair})",
        washed,
        f"{result['seconds']:.0f} s",
        "; ".join(notes) or "–",
    ]


def page(target):
    """Writes docs/arms.md from what is kept."""
    rows, refused, pictures, sources = [], [], [], []
    for name, (arm, repository, file, arguments, _) in ARMS.items():
        kept = KEPT / f"{name}.json"
        if not kept.exists():
            continue
        result = json.loads(kept.read_text())
        sources.append(f"| {name} | {repository} | `{file}` | {f'`{arguments}`' if arguments else '–'} |")
        if result["text"] and json.loads(result["text"]).get("certificate", {}).get("verdict") == "pass":
            rows.append("| " + " | ".join(row(name, result)) + " |")
        else:
            lines = (result["messages"] + result["text"]).splitlines()
            why = next((line for line in reversed(lines) if "error" in line or "NOT" in line), lines[-1])
            refused.append(f"- {arm}: {why}")
        if (target / f"{name}.jpg").exists():
            pictures.append(f"![{arm}](pictures/arms/{name}.jpg)")
    told = "## Refused\n\n" + "\n".join(refused) + "\n\n" if refused else ""
    text = TEXT.format(
        date=time.strftime("%Y-%m-%d"),
        rows="\n".join(rows),
        refused=told,
        pictures="\n".join(pictures),
        sources="\n".join(sources),
    )
    (HERE.parent / "arms.md").write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=Path, help="the platewash program")
    parser.add_argument("folder", type=Path, help="folder of the expanded descriptions")
    parser.add_argument("names", nargs="*", help="arms to do again; all by default")
    arguments = parser.parse_args()
    target = HERE / "arms"
    target.mkdir(exist_ok=True)
    names = arguments.names or ARMS
    for name in names:
        measure(str(arguments.command.resolve()), arguments.folder, name)
    for name in names:
        picture(name, target)
    page(target)


if __name__ == "__main__":
    main()
