"""One plate's wash path to joints free of collision, ours against Tesseract's Descartes, in turns.

    cargo build --release --manifest-path benches/peers/Cargo.toml --bin washed_plate
    python3 -m venv target/tesseract && target/tesseract/bin/pip install tesseract-robotics==0.5.1
    target/tesseract/bin/python benches/peers/redundancy_against_tesseract.py [--rounds 21] [--plate 0]

Tesseract gets 361 places of the tip along the path, the tool straight down, the analytic solver of its own, the same
primitives and the same pairs but the sponge with the plates; collision is checked at the vertices. Ours takes its own waypoints on
the same path, of which there are more, leaves yaw and tilt free, and keeps 10 mm of clearance.
"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time
import xml.etree.ElementTree as ElementTree
from itertools import combinations
from pathlib import Path

import numpy as np
from tesseract_robotics.tesseract_command_language import (
    CartesianWaypoint,
    CartesianWaypointPoly_wrap_CartesianWaypoint,
    CompositeInstruction,
    InstructionPoly_as_MoveInstructionPoly,
    MoveInstruction,
    MoveInstructionPoly_wrap_MoveInstruction,
    MoveInstructionType_LINEAR,
    ProfileDictionary,
    WaypointPoly_as_StateWaypointPoly,
)
from tesseract_robotics.tesseract_common import (
    GeneralResourceLocator,
    Isometry3d,
    ManipulatorInfo,
    Quaterniond,
    Translation3d,
)
from tesseract_robotics.tesseract_environment import Environment
from tesseract_robotics.tesseract_motion_planners import PlannerRequest
from tesseract_robotics.tesseract_motion_planners_descartes import (
    DescartesDefaultPlanProfileD,
    DescartesMotionPlannerD,
    cast_DescartesPlanProfileD,
)

ROOT = Path(__file__).resolve().parents[2]
NAMESPACE = "DescartesMotionPlannerTask"
# Ortho-parallel basis with a spherical wrist: the dimensions of the IRB 120 [m].
OPW = "a1: 0.0, a2: -0.07, b: 0.0, c1: 0.29, c2: 0.27, c3: 0.302, c4: 0.072"
PLUGINS = f"""
kinematic_plugins:
  search_libraries: [tesseract_kinematics_core_factories, tesseract_kinematics_kdl_factories, tesseract_kinematics_opw_factory]
  fwd_kin_plugins:
    arm:
      default: KDLFwdKinChain
      plugins:
        KDLFwdKinChain: {{class: KDLFwdKinChainFactory, config: {{base_link: base_link, tip_link: tool0}}}}
  inv_kin_plugins:
    arm:
      default: OPWInvKin
      plugins:
        OPWInvKin:
          class: OPWInvKinFactory
          config:
            base_link: base_link
            tip_link: tool0
            params: {{{OPW}, offsets: [0, 0, -1.57079632679489662, 0, 0, 0], sign_corrections: [1, 1, 1, 1, 1, 1]}}
"""
CONTACT = """
contact_manager_plugins:
  search_libraries: [tesseract_collision_bullet_factories]
  discrete_plugins:
    default: BulletDiscreteBVHManager
    plugins:
      BulletDiscreteBVHManager: {class: BulletDiscreteBVHManagerFactory}
  continuous_plugins:
    default: BulletCastBVHManager
    plugins:
      BulletCastBVHManager: {class: BulletCastBVHManagerFactory}
"""


def cylinder(urdf, link, parent, shape, place):
    """Adds a cylinder about the z axis of `parent`, its middle at a place."""
    body = ElementTree.SubElement(urdf, "link", name=link)
    collision = ElementTree.SubElement(body, "collision")
    geometry = ElementTree.SubElement(collision, "geometry")
    ElementTree.SubElement(geometry, "cylinder", radius=repr(shape["radius_m"]), length=repr(2.0 * shape["half_length_m"]))
    joint(urdf, link, parent, place)


def joint(urdf, link, parent, xyz):
    fixed = ElementTree.SubElement(urdf, "joint", name=f"{link}_fixed", type="fixed")
    ElementTree.SubElement(fixed, "parent", link=parent)
    ElementTree.SubElement(fixed, "child", link=link)
    ElementTree.SubElement(fixed, "origin", xyz=" ".join(map(repr, xyz)))


def cell(plan, pairs) -> tuple[str, str]:
    """URDF and SRDF of the arm, its tool and the plates; everything but the arm stands upright."""
    urdf = ElementTree.parse(ROOT / "urdf" / "irb120.urdf").getroot()
    for link in urdf.iter("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
    tool = plan["job"]["workcell"]["tool"]
    for body in tool["bodies"]:
        cylinder(urdf, body["name"], "tool0", body["shape"]["cylinder"], body["pose"]["position_m"])
    sponge = tool["sponge"]
    shape = {"radius_m": sponge["radius_m"], "half_length_m": 0.5 * sponge["height_m"]}
    cylinder(urdf, "sponge", "tool0", shape, sponge["pose"]["position_m"])
    ElementTree.SubElement(urdf, "link", name="tip")
    joint(urdf, "tip", "tool0", tool["tip"]["position_m"])
    names = [link.get("name") for link in urdf.iter("link")]
    for k, plate in enumerate(plan["job"]["plates"]):
        x, y, z = plate["pose"]["position_m"]
        half = 0.5 * plate["thickness_m"]
        shape = {"radius_m": plate["surface"]["radius_m"], "half_length_m": half}
        cylinder(urdf, f"plate {k}", "base_link", shape, (x, y, z - half))
        names.append(f"plate {k}")
    checked = {frozenset(pair) for pair in pairs}
    srdf = ElementTree.Element("robot", name=urdf.get("name"), version="1.0.0")
    group = ElementTree.SubElement(srdf, "group", name="arm")
    ElementTree.SubElement(group, "chain", base_link="base_link", tip_link="tool0")
    ElementTree.SubElement(srdf, "kinematics_plugin_config", filename="package://cell/kinematics.yaml")
    ElementTree.SubElement(srdf, "contact_managers_plugin_config", filename="package://cell/contact.yaml")
    for a, b in combinations(names, 2):
        touching = a == "sponge" and b.startswith("plate")
        if touching or frozenset((a, b)) not in checked:
            ElementTree.SubElement(srdf, "disable_collisions", link1=a, link2=b, reason="not checked")
    return ElementTree.tostring(urdf, "unicode"), ElementTree.tostring(srdf, "unicode")


class Tesseract:
    def __init__(self, work, folder):
        package = folder / "cell"
        package.mkdir()
        (package / "package.xml").write_text("<package><name>cell</name></package>")
        (package / "kinematics.yaml").write_text(PLUGINS)
        (package / "contact.yaml").write_text(CONTACT)
        self.locator = GeneralResourceLocator()
        self.locator.loadEnvironmentVariable("PLATEWASH_CELL")
        urdf, srdf = cell(work["plan"], work["pairs"])
        self.environment = Environment()
        if not self.environment.init(urdf, srdf, self.locator):
            raise SystemExit("Tesseract did not take the cell")
        self.manipulator = ManipulatorInfo()
        self.manipulator.manipulator = "arm"
        self.manipulator.manipulator_ik_solver = "OPWInvKin"
        self.manipulator.tcp_frame = "tip"
        self.manipulator.working_frame = "base_link"
        self.program = self.path(work["places_m"])
        self.profile = DescartesDefaultPlanProfileD()
        self.profile.enable_collision = True
        self.profile.enable_edge_collision = False
        self.cast = cast_DescartesPlanProfileD(self.profile)
        self.profiles = ProfileDictionary()
        self.profiles.addProfile(NAMESPACE, "PATH", self.cast)
        self.planner = DescartesMotionPlannerD(NAMESPACE)

    def path(self, places):
        program = CompositeInstruction("PATH")
        program.setManipulatorInfo(self.manipulator)
        for place in places:
            # The tool straight down: a half turn about y.
            pose = Isometry3d.Identity() * Translation3d(*place) * Quaterniond(0.0, 0.0, 1.0, 0.0)
            waypoint = CartesianWaypointPoly_wrap_CartesianWaypoint(CartesianWaypoint(pose))
            move = MoveInstruction(waypoint, MoveInstructionType_LINEAR, "PATH", self.manipulator)
            program.appendMoveInstruction(MoveInstructionPoly_wrap_MoveInstruction(move))
        return program

    def __call__(self):
        request = PlannerRequest()
        request.instructions = self.program
        request.env = self.environment
        request.profiles = self.profiles
        start = time.perf_counter()
        response = self.planner.solve(request)
        spent = time.perf_counter() - start
        if not response.successful:
            raise SystemExit(f"Tesseract found no path: {response.message}")
        # These objects die with their owners: each owner has a name.
        results = response.results
        instructions = results.flatten()
        joints = []
        for instruction in instructions:
            move = InstructionPoly_as_MoveInstructionPoly(instruction)
            waypoint = move.getWaypoint()
            state = WaypointPoly_as_StateWaypointPoly(waypoint)
            joints.append(np.array(state.getPosition()).ravel())
        return spent, len(joints), np.abs(np.diff(joints, axis=0)).sum()


class Ours:
    def __init__(self, plate, radius):
        binary = ROOT / "benches" / "peers" / "target" / "release" / "washed_plate"
        self.process = subprocess.Popen(
            [binary, str(plate), str(radius)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self.work = json.loads(self.process.stdout.readline())

    def __call__(self):
        self.process.stdin.write("again\n")
        self.process.stdin.flush()
        spent, count, travel = self.process.stdout.readline().split()
        return float(spent) * 1e-9, int(count), float(travel)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=21)
    parser.add_argument("--plate", type=int, default=0)
    parser.add_argument("--radius", type=float, default=0.12)
    options = parser.parse_args()
    ours = Ours(options.plate, options.radius)
    with tempfile.TemporaryDirectory() as folder:
        os.environ["PLATEWASH_CELL"] = folder
        theirs = Tesseract(ours.work, Path(folder))
        ours(), theirs()
        spent = [(ours(), theirs()) for _ in range(options.rounds)]
    ratio = statistics.median(a[0] / b[0] for a, b in spent)
    print("| who | configurations | ms | joint travel rad |")
    print("| --- | ---: | ---: | ---: |")
    for name, who in (("platewash", 0), ("Tesseract", 1)):
        _, count, travel = spent[0][who]
        print(f"| {name} | {count} | {statistics.median(s[who][0] for s in spent) * 1e3:.2f} | {travel:.2f} |")
    print(f"\nours / theirs: {ratio:.4f}")


if __name__ == "__main__":
    main()
