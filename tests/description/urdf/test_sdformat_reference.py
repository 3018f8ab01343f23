"""The same robot as sdformat 12 converts it (recorded), our fixed joints lumped by hand."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest

from gazelle.description.context import ReadContext
from gazelle.description.model import Model
from gazelle.description.urdf import read_urdf
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import MassProperties, Pose, combined_mass_properties

pytestmark = pytest.mark.reference


@pytest.fixture(scope="module")
def robot(oracles_dir: Path) -> Model:
    text = (oracles_dir / "sdfin" / "gz.urdf").read_text(encoding="utf-8")
    model = read_urdf(text, context=ReadContext(None, Diagnostics(), "gz.urdf"))
    assert model is not None
    return model


@pytest.fixture(scope="module")
def recorded(oracles_dir: Path) -> ElementTree.Element:
    text = (oracles_dir / "sdf" / "print_gz_urdf.txt").read_text(encoding="utf-8")
    text = text[text.index("<sdf") : text.index("</sdf>") + 6].replace("ignition::", "ignition_")
    found = ElementTree.fromstring(text).find("model")
    assert found is not None
    return found


def _numbers(element: ElementTree.Element, path: str) -> list[float]:
    found = element.find(path)
    assert found is not None
    return [float(word) for word in (found.text or "").split()]


def test_lumped_mass_properties(robot: Model, recorded: ElementTree.Element) -> None:
    bodies = []
    for name in ("base_link", "laser_mount"):
        link = robot.link(name)
        pose = link.T_model_link @ link.inertial.T_link_com
        bodies.append(
            MassProperties(
                link.inertial.mass_kg, inertia_kg_m2=link.inertial.inertia_kg_m2
            ).transformed(pose)
        )
    whole = combined_mass_properties(bodies)
    inertial = recorded.find("link[@name='base_footprint']/inertial")
    words = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    assert whole.mass_kg == pytest.approx(_numbers(inertial, "mass")[0])
    assert whole.center_m == pytest.approx(_numbers(inertial, "pose")[:3], abs=1e-9)
    expected = [_numbers(inertial, f"inertia/{word}")[0] for word in words]
    assert whole.inertia_kg_m2 == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("name", ["arm_joint", "left_joint", "kept_fixed"])
def test_joint_frames(name: str, robot: Model, recorded: ElementTree.Element) -> None:
    x, y, z, roll, pitch, yaw = _numbers(recorded, f"joint[@name='{name}']/pose")
    expected = Pose.from_xyz_rpy((x, y, z), (roll, pitch, yaw))
    found = robot.joint(name).T_model_joint
    assert found.position_m == pytest.approx(expected.position_m, abs=1e-12)
    assert found.quat_xyzw == pytest.approx(expected.quat_xyzw, abs=1e-12)


def test_friction_of_lumped_collisions(robot: Model, recorded: ElementTree.Element) -> None:
    prefix = "link[@name='base_footprint']/collision[@name='base_footprint_fixed_joint_lump__"
    base = robot.link("base_link").collisions[0].surface
    laser = robot.link("laser_mount").collisions[0].surface
    path = "surface/friction/ode/mu"
    assert [base.mu1] == _numbers(recorded, f"{prefix}base_link_collision']/{path}")
    assert [laser.mu1] == _numbers(recorded, f"{prefix}laser_mount_collision_1']/{path}")
    assert laser.mu2 is None


def test_words_of_the_wheel_and_its_joint(robot: Model, recorded: ElementTree.Element) -> None:
    link, joint = robot.link("left_wheel"), robot.joint("left_joint")
    xml = recorded.find("link[@name='left_wheel']")
    assert [link.linear_damping] == _numbers(xml, "velocity_decay/linear")
    assert (link.gravity, link.self_collide) == (False, True)
    xml = recorded.find("joint[@name='left_joint']")
    axis = joint.axis
    assert [axis.damping] == _numbers(xml, "axis/dynamics/damping")
    assert [axis.friction] == _numbers(xml, "axis/dynamics/friction")
    assert [axis.spring_stiffness] == _numbers(xml, "axis/dynamics/spring_stiffness")
    assert [axis.spring_reference] == _numbers(xml, "axis/dynamics/spring_reference")
    assert [joint.limit_cfm, joint.limit_erp] == [
        *_numbers(xml, "physics/ode/limit/cfm"),
        *_numbers(xml, "physics/ode/limit/erp"),
    ]


def test_nothing_is_lumped_or_dropped(robot: Model, recorded: ElementTree.Element) -> None:
    assert len(robot.links) == 7
    assert len(recorded.findall("link")) == 4
    assert robot.link("noinertia").inertial.estimated
    assert [sensor.name for sensor in robot.link("laser_mount").sensors] == ["scan"]
