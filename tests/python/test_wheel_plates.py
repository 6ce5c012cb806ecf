"""The wheel's plates with profiles, rings on them, and the keys of contact."""

import copy
import json
import math
import pickle
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyplatewash as pw

PROFILES = {"coupe275": 0.137, "rim270": 0.135, "deep230": 0.115, "dessert190": 0.095}
RINGS = pw.Rings(count=3, inner_m=0.0243, lead_rad=2.02, blend_rad=1.77)


def heights(knots: tuple[tuple[float, float], ...], radii: np.ndarray) -> np.ndarray:
    """Height over the pole by integrating tan β, with sin β linear in the radius between knots."""
    at = np.array([(0.0, 0.0), *knots])
    fine = np.unique(np.concatenate([np.linspace(0, at[-1, 0], 400_001), at[:, 0]]))
    sine = np.interp(fine, at[:, 0], np.sin(at[:, 1]))
    slope = sine / np.sqrt(1 - sine**2)
    height = np.concatenate([[0.0], np.cumsum((slope[1:] + slope[:-1]) / 2 * np.diff(fine))])
    found: np.ndarray = np.interp(radii, fine, height)
    return found


@pytest.mark.parametrize("name", PROFILES)
def test_a_profile_by_its_name_is_one_by_its_knots(name: str) -> None:
    plate = pw.Plate(x_m=0.3, y_m=0.1, profile=name, thickness_m=0.005, foot=pw.Foot(radius_m=0.05, height_m=0.004))
    assert plate.radius_m == PROFILES[name] and plate.profile is not None and len(plate.profile) >= 5
    assert plate == pw.Plate(x_m=0.3, y_m=0.1, profile=plate.profile, thickness_m=0.005, foot=plate.foot, radius_m=PROFILES[name])
    assert plate == pw.Plate(x_m=0.3, y_m=0.1, profile=np.array(plate.profile), thickness_m=0.005, foot=plate.foot)
    assert hash(plate) == hash(copy.copy(plate)) and plate == pickle.loads(pickle.dumps(plate)) == replace(plate)
    assert replace(plate, x_m=0.0) != plate and plate.foot == pw.Foot(radius_m=0.05, height_m=0.004)


def test_a_level_profile_is_a_disc() -> None:
    disc = pw.Plate(x_m=0.3, y_m=0.0, radius_m=0.12)
    assert pw.Plate(x_m=0.3, y_m=0.0, profile=[(0.05, 0.0), (0.12, 0.0)]) == disc == pw.Plate(x_m=0.3, y_m=0.0, profile="flat", radius_m=0.12)
    assert disc.profile is None and disc.foot is None


def test_plates_that_make_no_sense_are_refused() -> None:
    refused: list[tuple[Any, str]] = [
        ("soup", "plate.profile: knots, 'flat' or one of 'coupe275', 'rim270', 'deep230', 'dessert190' is needed; found 'soup'"),
        ([], "plate.profile"),
        ([(0.1, 0.2, 0.3)], "plate.profile"),
        ([(0.1, 0.2), (0.1, 0.3)], "knot 1 of the profile: radius 0.1 m"),
        ([(0.1, 1.2)], "knot 0 of the profile: slope 1.2 rad"),
        ([(0.1, math.nan)], "plate.profile|slope"),
        ([(0.01 * k, 0.1) for k in range(1, 20)], "from 1 to 16 knots; found 19"),
    ]
    for profile, words in refused:
        with pytest.raises(pw.InputError, match=words):
            pw.Plate(x_m=0.3, y_m=0.0, profile=profile)
    with pytest.raises(pw.InputError, match=r"plate.radius_m: is that of the profile's last knot, 0.135: leave it out; found 0.2"):
        pw.Plate(x_m=0.3, y_m=0.0, profile="rim270", radius_m=0.2)
    with pytest.raises(TypeError, match="plate.foot: a Foot is needed"):
        pw.Plate(x_m=0.3, y_m=0.0, foot=3)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    for wrong in (-0.1, math.inf, math.nan):
        with pytest.raises(pw.InputError, match="foot.height_m"):
            pw.Foot(radius_m=0.05, height_m=wrong)


def test_rings_are_circles_joined_by_blends() -> None:
    curve = pw.WashCurve(radius_m=0.121, turns=RINGS.turns, rings=RINGS)
    theta, points = curve.sample(1e-6)
    radii = np.hypot(*points.T)
    lead = RINGS.lead_rad * np.array([1.0, 2 ** (-3 / 8)])
    blend = RINGS.blend_rad * np.array([1.0, 2 ** (-3 / 8)])
    assert RINGS.turns == pytest.approx(sum(2 * np.pi - lead + blend) / (2 * np.pi), rel=1e-12)
    np.testing.assert_allclose(radii[theta <= 2 * np.pi - lead[0]], 0.0243, atol=1e-15)
    np.testing.assert_allclose(radii[theta >= 2 * np.pi * RINGS.turns], 0.121, atol=1e-15)
    assert theta[-1] == pytest.approx(2 * np.pi * (RINGS.turns + 1), rel=1e-12) and np.all(np.diff(radii) > -1e-15)
    # Half-way through the first blend it is half-way to the next ring.
    middle = 2 * np.pi - lead[0] + blend[0] / 2
    assert np.interp(middle, theta, radii) == pytest.approx((0.0243 + (0.0243 + 0.121) / 2) / 2, abs=1e-5)


@pytest.mark.parametrize("name", PROFILES)
@pytest.mark.parametrize("rings", [None, RINGS])
def test_a_curve_lies_on_its_plate(name: str, rings: pw.Rings | None) -> None:
    plate = pw.Plate(x_m=0.3, y_m=0.0, profile=name)
    assert plate.profile is not None
    curve = pw.WashCurve(radius_m=0.09, turns=rings.turns if rings else 2.5, start_angle_rad=0.3, rings=rings)
    theta, points, normals = curve.on(plate, 1e-5)
    assert theta.shape == (len(theta),) and points.shape == normals.shape == (len(theta), 3)
    radii = np.hypot(points[:, 0], points[:, 1])
    np.testing.assert_allclose(points[:, 2], heights(plate.profile, radii), atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-12)
    # Lengths are along the meridian: at the end it is as far from the pole as its radius says.
    rim = np.linspace(0, radii[-1], 200_001)
    arc = np.hypot(np.diff(rim), np.diff(heights(plate.profile, rim))).sum()
    assert arc == pytest.approx(0.09, abs=1e-8)
    # Directions along the curve are across the normals.
    along = np.diff(points, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    assert abs(np.einsum("ij,ij->i", along, normals[1:] + normals[:-1])).max() < 0.02
    flat = pw.WashCurve(radius_m=0.09, turns=curve.turns, start_angle_rad=0.3, rings=rings)
    np.testing.assert_array_equal(flat.on(pw.Plate(x_m=0, y_m=0), 1e-4)[1][:, :2], flat.sample(1e-4)[1])


def test_curves_that_make_no_sense_are_refused() -> None:
    with pytest.raises(pw.InputError, match=r"curve.turns: must be those of its rings, 1\.9"):
        pw.WashCurve(radius_m=0.121, turns=2.0, rings=RINGS)
    with pytest.raises(pw.InputError, match="rings.inner_m: must be below curve.radius_m = 0.02"):
        pw.WashCurve(radius_m=0.02, turns=RINGS.turns, rings=RINGS)
    for wrong in ({"count": 1}, {"count": 101}, {"inner_m": -1.0}, {"lead_rad": 7.0}, {"blend_rad": 0.0}, {"blend_rad": math.nan}):
        with pytest.raises(pw.InputError, match=f"rings.{next(iter(wrong))}"):
            replace(RINGS, **wrong)


def test_a_job_keeps_its_profiles() -> None:
    plates = [pw.Plate(x_m=0.4, y_m=0.0, profile="dessert190", thickness_m=0.005, foot=pw.Foot(radius_m=0.05, height_m=0.004)), pw.Plate(x_m=0.0, y_m=0.4)]
    job = pw.Scenario.load("kitchen-spiral").job().on_plates(plates)
    assert job.plates == plates


def test_the_stiffness_of_a_sponge_is_stated_in_pascals_and_kilopascals() -> None:
    tool = pw.Tool(length_m=0.15, sponge_compression_m=0.006, sponge_stiffness_pa=(11e3, 44e3))
    scenario = pw.Scenario.load("kitchen-spiral").replace(tool=tool)
    assert scenario.tool.sponge_stiffness_kpa == [11.0, 44.0]
    assert scenario.job().workcell.tool.sponge.stiffness_pa == [11e3, 44e3]
    # A tool without it takes it away.
    assert scenario.replace(tool=pw.Tool(length_m=0.15)).tool.sponge_stiffness_kpa is None
    for wrong in ((44e3, 11e3), (0.0, 1.0), (1.0, math.nan), (1.0, 1e10)):
        with pytest.raises(pw.InputError, match="tool.sponge_stiffness_pa: must be"):
            pw.Tool(sponge_stiffness_pa=wrong)


def test_the_promise_about_contact_is_read_and_changed() -> None:
    kitchen, spiral = pw.Scenario.load("kitchen"), pw.Scenario.load("kitchen-spiral")
    wash = kitchen.wash
    assert (wash.contact, wash.contact_share, wash.turns, wash.path_radius_m, wash.pattern) == (True, 0.995, None, None, None)
    assert (spiral.wash.contact, spiral.wash.contact_share, spiral.wash.turns) == (False, None, 3.5)
    asked = kitchen.job().requirements
    assert asked.contact.to_dict() == {
        "compression_m": 1e-3, "height_error_m": 1e-3, "share": 0.995, "strain": 0.6, "force_n": [1.0, 40.0],
        "time_s": 0.05, "time_share": 0.98, "dose_pa_m": 25.0, "dose_share": 0.98,
    }  # fmt: skip
    assert (asked.landing_m_s, asked.lifting_m_s, asked.wrist_rad) == (0.05, 0.05, math.radians(3))
    assert "contact" not in spiral.job().requirements
    stricter = kitchen.replace(wash={"contact_height_error_m": 0.002, "pattern": "rings", "turns": 2, "tilt_deg": 8.0}).job()
    assert stricter.requirements.contact.height_error_m == 0.002
    with pytest.raises(pw.ScenarioError, match="wash.contact_share: says how much contact there must be, which wash.contact = true asks for"):
        spiral.replace(wash={"contact_share": 0.9})
    with pytest.raises(pw.ScenarioError, match="wash.tilt_deg"):
        kitchen.replace(wash={"tilt_deg": 16.0})


def test_a_certificate_says_what_is_proved_of_contact() -> None:
    kitchen, spiral = pw.Scenario.load("kitchen"), pw.Scenario.load("kitchen-spiral")
    job = kitchen.job()
    plan = pw.plan(job).plan
    certificate = pw.prove(plan)
    assert certificate.proved, str(certificate)
    assert [plate.plate for plate in certificate.contact] == [plate.plate for plate in certificate.swept] == list(plan.order)
    asked = job.requirements.contact
    for plate in certificate.contact:
        assert plate.pressed.at_least >= asked.share == plate.pressed.required and plate.pressed.threshold == asked.compression_m
        assert plate.time.at_least >= asked.time_share and plate.time.threshold == asked.time_s
        assert plate.dose.at_least >= asked.dose_share and plate.dose.threshold == asked.dose_pa_m
        assert 0.2 < plate.strain.seen <= plate.strain.bound <= asked.strain
        least, most = asked.force_n
        assert least <= plate.least_force_n.bound <= plate.least_force_n.seen
        assert plate.least_force_n.seen < plate.greatest_force_n.seen <= plate.greatest_force_n.bound <= most
        assert 0.0 <= plate.greatest_force_n.time_s <= certificate.duration_s and len(plate.strain.place_m) == 3
        # Friction of 0.3 and of 1.0.
        assert plate.friction_torque_nm[1] == pytest.approx(plate.friction_torque_nm[0] / 0.3)
    names = [check.requirement for check in certificate.checks]
    assert {"pressed", "contact_time", "contact_dose", "strain", "contact_force", "wrist"} <= set(names)
    assert certificate.to_dict()["contact"][0] == certificate.contact[0].to_dict()
    assert pickle.loads(pickle.dumps(certificate)) == certificate
    # Nothing is said of contact where nothing is asked.
    assert pw.prove(pw.plan(spiral.job()).plan).contact == []


def test_what_holds_a_plate_is_stated_and_judged() -> None:
    kitchen = pw.Scenario.load("kitchen")
    assert kitchen.holder.to_dict() == {} and "holder" not in kitchen.job().requirements.to_dict()
    held = kitchen.replace(holder={"force_n": 20.0, "torque_nm": 3.0})
    assert held.holder.force_n == 20.0
    job = held.job()
    assert job.requirements.holder.to_dict() == {"sponge_friction": 1.0, "fixture": {"force_n": 20.0, "torque_nm": 3.0}}
    certificate = pw.prove(pw.plan(job).plan)
    assert [check.requirement for check in certificate.broken] == ["plate_stays"]
    load = certificate.contact[0].holder_load
    assert load.sponge_friction == [0.3, 1.0] and load.lateral_n[1] > 20.0 and load.torque_nm[1] < 3.0
    with pytest.raises(pw.ScenarioError, match="holder.force_n: give both force_n and torque_nm, or neither"):
        kitchen.replace(holder={"force_n": 20.0})


def test_refuses_a_plan_that_presses_too_little() -> None:
    plan = pw.plan(pw.Scenario.load("kitchen").job()).plan
    table = plan.to_dict()
    table["job"]["requirements"]["contact"]["share"] = 0.99999
    certificate = pw.prove(pw.Plan.from_json(json.dumps(table)))
    assert [check.requirement for check in certificate.broken] == ["pressed"] and not certificate.proved
    assert certificate.contact[0].pressed.required == 0.99999


def test_plates_of_a_table_are_planned_and_proved(root: Path, platewash: Path, tmp_path: Path) -> None:
    scenario = root / "examples" / "plates" / "twelve.toml"
    planned = pw.plan(scenario)
    certificate = pw.prove(planned)
    assert certificate.verdict == "pass" and len(certificate.contact) == 12
    plates = planned.job.plates
    assert [plate.height_error_m for plate in plates[:3]] == pytest.approx([0.0008, 0.0006, 0.0005])
    assert {plate.soil for plate in plates} == {0, 1, 2} and all(plate.deviation_m is None for plate in plates)
    assert {contact["dose"]["threshold"] for contact in certificate.contact} == {40.0, 80.0, 150.0}
    # The scenario that is changed still names its files.
    assert pw.Scenario.load(scenario).replace(seed=2).job().plates == plates
    subprocess.run([platewash, "plan", "--quiet", "--scenario", scenario, "--out", tmp_path], check=True, capture_output=True)
    assert (tmp_path / "plan.json").read_text() == planned.plan.to_json()
