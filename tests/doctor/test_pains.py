"""Each pain's broken package is found wrong, at its place; its clean twin is not."""

from __future__ import annotations

import pytest
from tests.doctor.conftest import FIXTURES, Examine, codes

from gazelle.doctor import Report

# Pain, launch file, code, severity, file and line of the place, words of message and fix.
BROKEN = [
    ("03_uris", "robot", "urdf.mesh-missing", "warning", "robot.urdf:106",
     "did you mean 'package://pain_03_uris/meshes/flag.stl'?", ""),
    ("03_uris", "world", "doctor.world-missing", "error", "world.launch:2",
     "yard.world' not found", "did you mean 'field.world'?"),
    ("07_xacro", "robot", "doctor.description-not-expanded", "error", "robot.launch:5",
     "holds xacro that nobody has expanded", "(find xacro)/xacro FILE"),
    ("07_xacro", "robot", "xml.bad-number", "error", "robot.urdf.xacro:13",
     "<box size>: '${size}' is not a finite number", ""),
    ("12_clock", "robot", "doctor.sim-time-off", "warning", "robot.launch:5",
     "/use_sim_time is not set while '/gazebo' publishes /clock", 'value="true"'),
    ("12_clock", "robot", "doctor.sim-time-name", "warning", "robot.launch:3",
     "'/robot/use_sim_time' has no effect", 'name="/use_sim_time"'),
    ("12_clock", "two_clocks", "doctor.two-clocks", "error", "two_clocks.launch:5",
     "'/gazebo' and '/second' both publish /clock", "keep one simulator"),
    ("12_clock", "two_clocks", "doctor.sim-time-name", "warning", "two_clocks.launch:3",
     "did you mean 'use_sim_time'?", 'name="/use_sim_time"'),
    ("12_clock", "no_clock", "doctor.no-clock", "info", "no_clock.launch:2",
     "nothing in this launch publishes /clock", ""),
    ("13_frames", "robot", "doctor.joint-without-state", "warning", "robot.launch:7",
     "left_wheel_joint, right_wheel_joint on /joint_states", "joint_state_publisher"),
    ("13_frames", "robot", "doctor.frames-apart", "warning", "robot.launch:7",
     "tf falls into 2 parts that nobody connects: odom (with base_footprint); base_link",
     "let the plug-in name 'base_link' as its base frame"),
    ("13_frames", "robot", "doctor.sensor-frame", "warning", "robot.urdf:134",
     "stamps its data with frame 'laser', which no tf leads to",
     "write <frameName>laser_link</frameName>"),
    ("13_frames", "twice", "doctor.frame-two-parents", "warning", "twice.launch:6",
     "frame 'laser_link' gets 2 parents", "only one of the nodes"),
    ("13_frames", "twice", "doctor.frame-published-twice", "warning", "twice.launch:5",
     "/state_publisher and /again publish the same transforms: base_link → left_wheel",
     "only one of them"),
    ("13_frames", "no_description", "doctor.no-description", "error", "no_description.launch:5",
     "there is /robot/robot_description", 'to="/robot/robot_description"'),
    ("13_frames", "bad_arguments", "doctor.bad-arguments", "error", "bad_arguments.launch:2",
     "static_transform_publisher got 7 arguments", ""),
    ("17_plugins", "robot", "plugin.unknown", "warning", "robot.urdf:117",
     "'libarm_cannon.so' (name 'arm_cannon') of model 'robot' is compiled code", ""),
    ("17_plugins", "robot", "parameter.unknown", "warning", "robot.urdf:113",
     "has no key <wheelSeperation>", "did you mean 'wheelSeparation'"),
    ("23_namespaces", "robot", "doctor.no-controller-manager", "error", "robot.launch:8",
     "waits for /robot/controller_manager, which nobody runs; there is /rover/controller_manager",
     'ns="/rover"'),
    ("23_namespaces", "robot", "doctor.remap-unused", "warning", "robot.launch:9",
     "the remap from 'jointstates' to '/rover/joint_states' is of no use",
     "did you mean '/joint_states'?"),
    ("23_namespaces", "robot", "doctor.topic-elsewhere", "warning", "robot.launch:12",
     "listens to '/scan', which nobody in this launch publishes; there is '/rover/scan'",
     'to="/rover/scan"'),
    ("23_namespaces", "controllers", "doctor.controller-fails", "error", "controllers.launch:8",
     "cannot load controller 'lefft'", "did you mean 'left'?"),
]  # fmt: skip
CLEAN = [
    ("03_uris", "robot"),
    ("03_uris", "world"),
    ("07_xacro", "robot"),
    ("12_clock", "robot"),
    ("13_frames", "robot"),
    ("17_plugins", "robot"),
    ("23_namespaces", "robot"),
]
_reports: dict[tuple[str, str, str], Report] = {}


def _examined(pain: str, kind: str, launch: str, examined: Examine) -> Report:
    """Return the report on a launch; several rows are about the same one."""
    key = (pain, kind, launch)
    if key not in _reports:
        package = f"pain_{pain}"
        _reports[key] = examined(FIXTURES / package / kind, package, f"{launch}.launch")
    return _reports[key]


@pytest.mark.parametrize(
    ("pain", "launch", "code", "severity", "place", "message", "fix"),
    BROKEN,
    ids=[f"{row[0]}-{row[1]}-{row[2]}" for row in BROKEN],
)
def test_broken_package_is_found_wrong_at_its_place(
    pain: str, launch: str, code: str, severity: str, place: str, message: str, fix: str,
    examined: Examine,
) -> None:  # fmt: skip
    report = _examined(pain, "broken", launch, examined)
    found = [item for item in report.findings if item.code == code and message in item.message]
    assert found, [str(item) for item in report.findings]
    item = found[0]
    assert item.span is not None
    assert f"{item.span.file.rpartition('/')[2]}:{item.span.line}" == place
    assert (str(item.severity), fix in item.fix) == (severity, True), item.fix


@pytest.mark.parametrize(("pain", "launch"), CLEAN)
def test_clean_twin_has_no_warning(pain: str, launch: str, examined: Examine) -> None:
    report = _examined(pain, "clean", launch, examined)
    assert codes(report) == [], [str(item) for item in report.findings]
    assert report.exit_code == 0
