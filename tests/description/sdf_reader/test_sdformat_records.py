"""Documents that the real sdformat read, checked and converted: what it said, we say."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import NamedTuple

import pytest
from tests.shared_files import SHARED, shared_cases

from gazelle.description.sdf_reader import read_model_file, read_world_file
from gazelle.diagnostics import Diagnostics

pytestmark = pytest.mark.reference

ORACLES = SHARED / "oracles"
OWN = Path(__file__).parents[1] / "converted"
RECORDED = Path(__file__).parents[2] / "workspaces/recorded/ign_sdf"


class Clash(NamedTuple):
    """A model with two links of one name and a joint to a link that is not there."""

    file: Path
    record: Path
    link: str
    joint: str
    child: str


@pytest.fixture
def found() -> Diagnostics:
    return Diagnostics()


@pytest.mark.parametrize(
    "clash",
    [
        Clash(OWN / "clash.sdf", RECORDED / "check_clash.txt", "post", "pivot", "gate"),
        *shared_cases(
            Clash(ORACLES / "sdfin/bad.sdf", ORACLES / "sdf/check_bad.txt", "l", "j", "zz")
        ),
    ],
)
def test_bad_file_is_refused_for_the_reasons_sdformat_gives(clash: Clash, found) -> None:
    """Each mistake once; sdformat prints ten lines for these two."""
    read_model_file(clash.file, workspace=None, diagnostics=found)
    recorded = clash.record.read_text(encoding="utf-8")
    assert f"link with name[{clash.link}] already exists" in recorded
    child = rf"Child frame with name\[{clash.child}\] specified by joint with name"
    assert re.search(rf"{child}\[{clash.joint}\] not found", recorded)
    assert [item.code for item in found.errors] == ["sdf.duplicate-name", "sdf.bad-joint"]
    assert f"link with name '{clash.link}'" in found.errors[0].message
    words = f"child frame with name '{clash.child}' specified by joint with name '{clash.joint}'"
    assert words in found.errors[1].message


@pytest.mark.parametrize(
    ("file", "record"),
    [
        (OWN / "bare.world", RECORDED / "print_bare.txt"),
        *shared_cases((ORACLES / "sdfin/w.sdf", ORACLES / "sdf/print_w.txt")),
    ],
    ids=lambda path: path.stem,
)
def test_defaults_are_those_that_sdformat_prints(file: Path, record: Path, found) -> None:
    world = read_world_file(file, workspace=None, diagnostics=found)
    recorded = record.read_text(encoding="utf-8")

    def numbers(element):
        text = re.search(f"<{element}>(.*?)</{element}>", recorded)[1]
        return tuple(float(word) for word in text.split())

    assert world.gravity_m_s2 == numbers("gravity")
    assert world.magnetic_field_t == numbers("magnetic_field")
    assert (world.physics.max_step_size_s,) == numbers("max_step_size")
    assert (world.physics.real_time_factor,) == numbers("real_time_factor")
    assert (world.physics.real_time_update_rate_hz,) == numbers("real_time_update_rate")
    assert world.scene.ambient == numbers("ambient")
    assert world.scene.background == numbers("background")
    assert not len(found)


def test_sdformats_conversion_of_our_urdf_is_read_with_the_urdfs_numbers(tmp_path, found) -> None:
    """Joints relative to their parent link, links relative to their joint, as sdformat writes."""
    recorded = (RECORDED / "print_trolley.txt").read_text(encoding="utf-8")
    file = tmp_path / "trolley.sdf"
    file.write_text(recorded[recorded.index("<sdf") : recorded.index("[stderr]")], "utf-8")
    model = read_model_file(file, workspace=None, diagnostics=found)
    assert model.canonical_link == "ground_point"
    assert model.link("lift").T_model_link.position_m == pytest.approx((0.1, 0, 0.35))
    wheel, joint = model.link("roller"), model.joint("roller_axle")
    assert wheel.T_model_link == joint.T_model_joint
    assert wheel.T_model_link.position_m == pytest.approx((0.3, -0.28, 0.12))
    assert wheel.T_model_link.rpy_rad == pytest.approx((1.5707963, 0, 0))
    assert (joint.axis.damping, joint.axis.friction) == (0.05, 0.15)
    assert (joint.axis.spring_stiffness, joint.axis.spring_reference) == (3, 0.1)
    assert (joint.provide_feedback, joint.implicit_spring_damper) == (True, True)
    assert (joint.limit_cfm, joint.limit_erp) == (0.2, 0.4)
    base = model.link("ground_point")
    assert [item.surface.mu1 for item in base.collisions] == [0.6, 0.25]
    assert [item.surface.mu2 for item in base.collisions] == [0.6, None]
    assert base.inertial.mass_kg == 12.4
    assert base.visuals[0].material.name == "Gazebo/Green"
    assert wheel.visuals[0].material.name == "Gazebo/Grey"
    assert (wheel.gravity, wheel.self_collide, wheel.linear_damping) == (False, True, 0.2)
    lift = model.joint("lift_rail")
    assert lift.axis.xyz == pytest.approx((math.sqrt(0.5), 0, math.sqrt(0.5)))
    assert (lift.axis.lower, lift.axis.upper, lift.axis.effort) == (-0.05, 0.35, 60)
    sensor = base.sensors[0]
    assert (sensor.type, sensor.update_rate_hz, sensor.spec.samples) == ("ray", 8, 180)
    assert [plugin.name for plugin in model.plugins] == ["drive"]
    assert {item.code for item in found} == {"sdf.missing-file"}
