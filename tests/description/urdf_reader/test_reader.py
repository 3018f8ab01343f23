from __future__ import annotations

import re
from pathlib import Path

import pytest
from tests.description.recorded_robots import OWN, SAMPLES, RecordedRobots
from tests.shared_files import shared_cases

from gazelle.diagnostics import Severity

NUMBER = "xml.bad-number"
# What must be found in each file of the recorded check_urdf runs, in order, beyond what the
# files lack on purpose (mass).
EXPECTED: dict[str, list[str]] = {
    "bad_axis": [NUMBER],
    "bad_joint_type": ["urdf.joint-type"],
    "bad_limit_number": [NUMBER],
    "bad_number_inertia": [NUMBER],
    "bad_number_mass": [NUMBER],
    "bad_number_xyz": [NUMBER],
    "bad_number_xyz_count": [NUMBER],
    "bad_rgba": ["urdf.bad-rgba"],
    "box_no_size": ["urdf.geometry-incomplete"],
    "calibration_bad": [NUMBER],
    "cylinder_no_length": ["urdf.geometry-incomplete"],
    "dup_joint": ["urdf.duplicate-joint"],
    "dup_link": ["urdf.duplicate-link"],
    "dynamics_empty": ["urdf.dynamics-empty"],
    "empty": ["xml.malformed"],
    "floating_planar": [],
    "good": [],
    "joint_no_name": ["urdf.joint-no-name"],
    "limit_no_effort": ["urdf.limit-incomplete"],
    "limit_no_velocity": ["urdf.limit-incomplete"],
    "link_no_name": ["urdf.link-no-name"],
    "loop": ["urdf.loop"],
    "malformed_xml": ["xml.malformed"],
    "mass_no_value": ["urdf.inertial-incomplete"],
    "mesh_bad_scale": [NUMBER],
    "mesh_no_filename": ["urdf.geometry-incomplete"],
    "mimic_no_joint": ["urdf.mimic-no-joint"],
    "missing_child": ["urdf.child-missing"],
    "missing_izz": ["urdf.inertial-incomplete"],
    "missing_limit": ["urdf.limit-missing"],
    "missing_limit_prismatic": ["urdf.limit-missing"],
    "missing_parent": ["urdf.parent-missing"],
    "nan_mass": [NUMBER],
    "neg_mass": ["urdf.negative-mass"],
    "nested_material_twice": ["urdf.duplicate-material"],
    "no_child_tag": ["urdf.joint-ends"],
    "no_inertia": ["urdf.inertial-incomplete"],
    "no_joint_type": ["urdf.joint-no-type"],
    "no_links": ["urdf.no-links"],
    "no_parent_tag": ["urdf.joint-ends"],
    "no_robot_name": ["urdf.no-robot-name"],
    "no_robot_tag": ["urdf.no-robot"],
    "safety_no_kv": ["urdf.safety-incomplete"],
    "sphere_no_radius": ["urdf.geometry-incomplete"],
    "trailing_number": [NUMBER],
    "truncated": ["xml.malformed"],
    "two_parents": ["urdf.two-parents"],
    "two_roots": ["urdf.two-roots"],
    "undefined_material": [],
    "unknown_geom": ["urdf.geometry-unknown"],
    "unknown_tag": [],
    "version2": ["urdf.version"],
    "zero_axis": ["urdf.zero-axis"],
}
# Wrong files that check_urdf accepts in silence; the real ones here must not.
SILENT = {"neg_mass", "two_parents", "zero_axis"}


@pytest.mark.parametrize("robots", [OWN, *shared_cases(SAMPLES)])
@pytest.mark.reference
def test_every_recorded_file_is_in_the_table(robots: RecordedRobots) -> None:
    assert set(robots.names) == set(EXPECTED)


@pytest.mark.reference
@pytest.mark.parametrize(
    ("robots", "stem"),
    [
        *((OWN, stem) for stem in sorted(EXPECTED)),
        *shared_cases(*((SAMPLES, stem) for stem in sorted(EXPECTED))),
    ],
)
def test_errors_mean_what_check_urdf_says(robots: RecordedRobots, stem: str, read) -> None:
    recorded = robots.run(stem)
    found = read(recorded.text)
    complains = "Error:" in recorded.err
    errors = [item for item in found.diagnostics if item.severity is Severity.ERROR]
    assert [item.code for item in errors] == EXPECTED[stem]
    assert bool(errors) == (complains or stem in SILENT)
    assert all(item.span is not None and item.span.line for item in errors)


@pytest.mark.reference
@pytest.mark.parametrize("robots", [OWN, *shared_cases(SAMPLES)])
def test_phrases_are_those_that_check_urdf_prints(robots: RecordedRobots, read) -> None:
    for stem in ("no_robot_name", "joint_no_name", "no_links", "dynamics_empty", "link_no_name"):
        recorded = robots.run(stem)
        found = read(recorded.text)
        assert next(iter(found.diagnostics)).phrase in re.sub(r"\s+", " ", recorded.err)


def test_all_mistakes_are_found_at_once_with_line_and_column(read) -> None:
    found = read(
        '<robot name="r">\n  <link name="a">\n'
        '    <inertial><mass value="x"/></inertial>\n  </link>\n'
        '  <joint name="j" type="hinge"><parent link="a"/><child link="a"/></joint>\n</robot>'
    )
    errors = {item.code: item.span for item in found.diagnostics.errors}
    assert set(errors) == {"xml.bad-number", "urdf.inertial-incomplete", "urdf.joint-type"}
    assert (errors["xml.bad-number"].line, errors["xml.bad-number"].column) == (3, 15)
    assert (errors["urdf.joint-type"].line, errors["urdf.joint-type"].column) == (5, 3)


def test_a_file_that_is_no_robot_names_its_root(read) -> None:
    found = read("<model/>")
    assert found.model is None
    assert "the file's root is <model>" in found.message("urdf.no-robot")


def test_frames_add_up_along_the_tree(read_joint) -> None:
    robot = read_joint('<origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/>').robot
    pose = robot.link("b").T_model_link
    assert pose.position_m == (1.0, 0.0, 0.0)
    assert pose.rpy_rad[2] == pytest.approx(1.5707963267948966)
    assert robot.joint("j").T_model_joint == pose


def test_root_link_world_is_the_world_itself(read) -> None:
    found = read(
        '<robot name="r"><link name="world"><visual><geometry><sphere radius="1"/></geometry>'
        '</visual></link><link name="a"/><joint name="j" type="fixed"><parent link="world"/>'
        '<child link="a"/><origin xyz="0 0 2"/></joint></robot>'
    )
    assert [link.name for link in found.robot.links] == ["a"]
    assert found.robot.joint("j").parent == "world"
    assert found.robot.canonical_link == "a"
    assert found.robot.link("a").T_model_link.position_m == (0.0, 0.0, 2.0)
    assert found.codes == ["urdf.world-link"]


def test_robot_origin_places_the_model(read_link) -> None:
    robot = read_link(after='<origin xyz="1 2 3"/>').robot
    assert robot.T_world_model.position_m == (1.0, 2.0, 3.0)


def test_sensor_of_urdf_is_ignored_with_a_notice(read_link) -> None:
    assert "never used" in read_link(after='<sensor name="s"/>').message("urdf.sensor-ignored")


def test_unknown_tag_is_reported_with_the_nearest_name(read_link) -> None:
    message = read_link(after='<jiont name="s"/>').message("xml.unknown-tag")
    assert "<jiont> is not known inside <robot>" in message
    assert "did you mean 'joint'" in message


def test_ros2_control_stays_xml(read_link) -> None:
    robot = read_link(after='<ros2_control name="c" type="system"><joint name="j"/></ros2_control>')
    (control,) = robot.robot.ros2_controls
    assert (control.name, control.type) == ("c", "system")
    assert control.element.find("joint").attributes == {"name": "j"}


def test_mimic_of_a_missing_joint_is_dropped_with_a_hint(read_joint) -> None:
    after = (
        '<link name="c"/><joint name="k" type="continuous"><parent link="a"/><child link="c"/>'
        '<mimic joint="jj"/></joint>'
    )
    found = read_joint(after=after)
    assert "which does not exist" in found.message("urdf.mimic-unknown")
    assert "did you mean 'j'" in found.message("urdf.mimic-unknown")
    assert found.robot.joint("k").mimic is None


def test_name_and_format_of_the_model(read_link) -> None:
    robot = read_link().robot
    assert (robot.name, robot.source_format, robot.canonical_link) == ("r", "urdf", "a")
    assert robot.file == Path("robot.urdf")
