"""The same robot as sdformat 12 converts it (recorded), our fixed joints lumped by hand."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import pytest
from tests.shared_files import SHARED, shared_cases

from gazelle.description.model import Model
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader import read_urdf
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import MassProperties, Pose, combined_mass_properties

pytestmark = pytest.mark.reference


class Converted(NamedTuple):
    """A robot, its record, and who is who in it.

    Attributes:
        root: link that all of the fixed ones are lumped into.
        body: first of these, with mass.
        mount: another one, with a sensor.
        wheel: link with Gazebo's own words.
        hinge: the wheel's joint.
        slide: a prismatic joint.
        kept: a fixed joint that is preserved.
        weightless: link without an inertial, which sdformat drops.
        sensor: of the mount.
    """

    file: Path
    record: Path
    root: str
    body: str
    mount: str
    wheel: str
    hinge: str
    slide: str
    kept: str
    weightless: str
    sensor: str


_OWN = Converted(
    Path(__file__).parents[1] / "converted/trolley.urdf",
    Path(__file__).parents[2] / "workspaces/recorded/ign_sdf/print_trolley.txt",
    "ground_point", "bed", "scanner_post", "roller", "roller_axle", "lift_rail", "badge_screw",
    "flag", "sweep",
)  # fmt: skip
_SAMPLE = Converted(
    SHARED / "oracles/sdfin/gz.urdf",
    SHARED / "oracles/sdf/print_gz_urdf.txt",
    "base_footprint", "base_link", "laser_mount", "left_wheel", "left_joint", "arm_joint",
    "kept_fixed", "noinertia", "scan",
)  # fmt: skip


@pytest.fixture(scope="module", params=[_OWN, *shared_cases(_SAMPLE)])
def converted(request: pytest.FixtureRequest) -> Converted:
    return request.param


@pytest.fixture(scope="module")
def robot(converted: Converted) -> Model:
    text = converted.file.read_text(encoding="utf-8")
    model = read_urdf(text, context=ReadContext(None, Diagnostics(), converted.file.name))
    assert model is not None
    return model


@pytest.fixture(scope="module")
def recorded(converted: Converted) -> ElementTree.Element:
    text = converted.record.read_text(encoding="utf-8")
    text = text[text.index("<sdf") : text.index("</sdf>") + 6].replace("ignition::", "ignition_")
    found = ElementTree.fromstring(text).find("model")
    assert found is not None
    return found


def _numbers(element: ElementTree.Element, path: str) -> list[float]:
    found = element.find(path)
    assert found is not None
    return [float(word) for word in (found.text or "").split()]


def test_lumped_mass_properties(
    converted: Converted, robot: Model, recorded: ElementTree.Element
) -> None:
    bodies = []
    for name in (converted.body, converted.mount):
        link = robot.link(name)
        pose = link.T_model_link @ link.inertial.T_link_com
        bodies.append(
            MassProperties(
                link.inertial.mass_kg, inertia_kg_m2=link.inertial.inertia_kg_m2
            ).transformed(pose)
        )
    whole = combined_mass_properties(bodies)
    inertial = recorded.find(f"link[@name='{converted.root}']/inertial")
    words = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    assert whole.mass_kg == pytest.approx(_numbers(inertial, "mass")[0])
    assert whole.center_m == pytest.approx(_numbers(inertial, "pose")[:3], abs=1e-9)
    expected = [_numbers(inertial, f"inertia/{word}")[0] for word in words]
    assert whole.inertia_kg_m2 == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("role", ["slide", "hinge", "kept"])
def test_joint_frames(
    role: str, converted: Converted, robot: Model, recorded: ElementTree.Element
) -> None:
    name = getattr(converted, role)
    x, y, z, roll, pitch, yaw = _numbers(recorded, f"joint[@name='{name}']/pose")
    expected = Pose.from_xyz_rpy((x, y, z), (roll, pitch, yaw))
    found = robot.joint(name).T_model_joint
    assert found.position_m == pytest.approx(expected.position_m, abs=1e-12)
    assert found.quat_xyzw == pytest.approx(expected.quat_xyzw, abs=1e-12)


def test_friction_of_lumped_collisions(
    converted: Converted, robot: Model, recorded: ElementTree.Element
) -> None:
    root, body, mount = converted.root, converted.body, converted.mount
    prefix = f"link[@name='{root}']/collision[@name='{root}_fixed_joint_lump__"
    base = robot.link(body).collisions[0].surface
    laser = robot.link(mount).collisions[0].surface
    path = "surface/friction/ode/mu"
    assert [base.mu1] == _numbers(recorded, f"{prefix}{body}_collision']/{path}")
    assert [laser.mu1] == _numbers(recorded, f"{prefix}{mount}_collision_1']/{path}")
    assert laser.mu2 is None


def test_words_of_the_wheel_and_its_joint(
    converted: Converted, robot: Model, recorded: ElementTree.Element
) -> None:
    link, joint = robot.link(converted.wheel), robot.joint(converted.hinge)
    xml = recorded.find(f"link[@name='{converted.wheel}']")
    assert [link.linear_damping] == _numbers(xml, "velocity_decay/linear")
    assert (link.gravity, link.self_collide) == (False, True)
    xml = recorded.find(f"joint[@name='{converted.hinge}']")
    axis = joint.axis
    assert [axis.damping] == _numbers(xml, "axis/dynamics/damping")
    assert [axis.friction] == _numbers(xml, "axis/dynamics/friction")
    assert [axis.spring_stiffness] == _numbers(xml, "axis/dynamics/spring_stiffness")
    assert [axis.spring_reference] == _numbers(xml, "axis/dynamics/spring_reference")
    assert [joint.limit_cfm, joint.limit_erp] == [
        *_numbers(xml, "physics/ode/limit/cfm"),
        *_numbers(xml, "physics/ode/limit/erp"),
    ]


def test_nothing_is_lumped_or_dropped(
    converted: Converted, robot: Model, recorded: ElementTree.Element
) -> None:
    assert len(robot.links) == 7
    assert len(recorded.findall("link")) == 4
    assert robot.link(converted.weightless).inertial.estimated
    assert [sensor.name for sensor in robot.link(converted.mount).sensors] == [converted.sensor]
