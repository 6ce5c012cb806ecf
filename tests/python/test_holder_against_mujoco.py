"""The load on what holds a plate, beside MuJoCo: a sponge of columns on springs, moved along a plan over a plate with sensors."""

import sys

import numpy as np
import pytest
from conftest import ROOT

import pyplatewash as pw
from wheel_plans import plan

sys.path.insert(0, str(ROOT / "crates" / "simulator" / "tests" / "fixtures"))

import mujoco_run  # noqa: E402
import mujoco_sponge  # noqa: E402

#: Steps over which a load is averaged: 20 ms, as columns chatter in between.
AVERAGED = 40
#: The plate lies so much higher than stated, of the millimetre that is proved [m].
RAISED_M = 5e-4


@pytest.mark.parametrize("friction", [0.3, 1.0])
def test_the_load_on_a_plate_stays_within_its_bounds_in_mujoco(friction):
    kitchen = plan("kitchen")
    first, table = kitchen.order[0], kitchen.to_dict()
    wash = next(segment for segment in kitchen.segments if segment.kind == "wash")
    times = np.arange(wash.t_start_s - 0.3, wash.t_end_s + 0.3, mujoco_sponge.STEP_S)
    positions, _, _ = mujoco_run.reference(table, times)
    # The plates of the kitchen lie level.
    poses = pw.Robot.irb120().fk(positions, tool=pw.Tool(length_m=0.15)).copy()
    plate = table["job"]["plates"][first]
    poses[:, :3, 3] -= plate["pose"]["position_m"]
    sponge = table["job"]["workcell"]["tool"]["sponge"]
    loads = mujoco_sponge.run(sponge, sponge["stiffness_pa"][1], plate["surface"]["radius_m"], friction, RAISED_M, poses)
    smooth = np.stack([np.convolve(load, np.full(AVERAGED, 1 / AVERAGED), "valid") for load in loads.T], axis=1)
    across_n, about_nm, along_n = smooth.max(axis=0)
    contact = next(contact for contact in pw.prove(kitchen).contact if contact.plate == first)
    held = contact.holder_load
    k = held.sponge_friction.index(friction)
    assert across_n <= held.lateral_n[k] and about_nm <= held.torque_nm[k]
    # So that a bound too small would be noticed.
    assert across_n > 0.85 * held.lateral_n[k] and about_nm > 0.8 * held.torque_nm[k]
    assert along_n > 0.85 * contact.greatest_force_n.bound
