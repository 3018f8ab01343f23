"""Which ROS each part of a package was written for, and the signs that tell it."""

from __future__ import annotations

import re
from pathlib import PurePosixPath
from typing import NamedTuple

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.packages.source import SourcePackage
from gazelle.doctor.report import Section

__all__ = [
    "SIGNS",
    "Sign",
    "VersionSign",
    "check_ros_versions",
    "ros_versions_section",
    "version_signs",
]

_LAUNCH1 = (".launch", ".launch.xml")
_LAUNCH2 = (".launch.py", "_launch.py", ".launch.xml", ".launch.yaml")
_ROBOT = (".urdf", ".xacro", ".xml", ".sdf", ".world", ".gazebo", ".trans")
_CODE = (".py",)
_CPP = (".cpp", ".cc", ".h", ".hpp")
_YAML = (".yaml", ".yml")
_AS_IT_IS = "runs as it is"
_ROWS: tuple[tuple[str, tuple[str, ...], str, str, int, str, str, bool], ...] = (
    # -- ROS 1 launch files
    ("launch", _LAUNCH1, r'pkg="gazebo"', "Fuerte and before", 1,
     "package gazebo became gazebo_ros in Groovy", "the old name is an alias", True),
    ("launch", _LAUNCH1, r"pr2_controller_manager", "Fuerte and before", 1,
     "pr2_controller_manager became controller_manager in Hydro", "the old name is an alias", True),
    ("launch", _LAUNCH1, r'type="state_publisher"', "Melodic and before", 1,
     "state_publisher was renamed to robot_state_publisher", "the old name is an alias", True),
    ("launch", _LAUNCH1, r"xacro\.py", "Melodic and before", 1,
     "xacro.py was removed in Noetic", "the old name is an alias", True),
    ("launch", _LAUNCH1, r"xacro\S*\s[^>]*--inorder", "Indigo to Melodic", 1,
     "--inorder is the rule since Melodic", "accepted, without effect", True),
    ("launch", _LAUNCH1, r'<param\s[^>]*name="use_gui"', "Melodic and before", 1,
     "use_gui moved to joint_state_publisher_gui in Noetic", _AS_IT_IS, True),
    ("launch", _LAUNCH1, r'<node\b[^>]*\stype\s*=', "ROS 1", 1,
     "<node type=…> is roslaunch's", _AS_IT_IS, True),
    ("launch", (".launch",), r'pkg="gazebo_ros"|\$\(find gazebo_ros\)', "Hydro to Noetic", 1,
     "gazebo_ros of ROS 1", "starts Gazelle's simulator", True),
    # -- ROS 2 launch files
    ("launch", _LAUNCH2, r"\bnode_(?:executable|name|namespace)\s*=", "Dashing to Foxy", 2,
     "Node(node_executable=…) became executable=… in Foxy, the old word went in Galactic", "read",
     True),
    ("launch", _LAUNCH2, r"spawn_entity\.py", "Foxy to Humble", 2,
     "spawn_entity.py spawns into Gazebo Classic, which Jazzy no longer has", "read", True),
    ("launch", _LAUNCH2, r"\bros_ign_gazebo\b|\bign gazebo\b", "Foxy to Humble", 2,
     "ros_ign_gazebo became ros_gz_sim in Humble", "read", True),
    ("launch", _LAUNCH2, r"\bros_gz_sim\b", "Humble and later", 2,
     "ros_gz_sim starts the new Gazebo", "read", True),
    ("launch", _LAUNCH2, r"""["']spawner\.py["']""", "Foxy to Galactic", 2,
     "spawner.py became spawner in Galactic", "read", True),
    ("launch", _LAUNCH2, r"MoveItConfigsBuilder", "Humble and later", 2,
     "moveit_configs_utils came with Humble", "read", True),
    ("launch", (".launch.py", "_launch.py"), r"generate_launch_description", "ROS 2", 2,
     "generate_launch_description() is ROS 2's", "read", True),
    # -- descriptions
    ("description", _ROBOT, r"<(?:controller|interface|sensor):\w+", "Diamondback to Fuerte", 1,
     "prefixed tags of Gazebo before 1.0", "read as their successors", False),
    ("description", _ROBOT, r"<hardwareInterface>\s*(?:Effort|Position|Velocity)Joint", "Hydro", 1,
     "hardware interfaces have their package in front since Indigo", "both are read", False),
    ("description", _ROBOT, r"<hardwareInterface>\s*hardware_interface/", "Indigo to Noetic", 1,
     "hardware_interface/… in <transmission>", "driven by ros_control's controllers", False),
    ("description", _ROBOT, r"libgazebo_ros_control\b", "Hydro to Noetic", 1,
     "gazebo_ros_control is ROS 1's", "driven by ros_control's controllers", False),
    ("description", _ROBOT, r"<robotNamespace>", "ROS 1", 1,
     "<robotNamespace> is a plug-in's parameter of ROS 1", "both are read", False),
    ("description", _ROBOT, r"gazebo_ros2_control/GazeboSystem", "Foxy to Humble", 2,
     "gazebo_ros2_control drives Gazebo Classic", "driven by ros2_control's controllers", False),
    ("description", _ROBOT, r"ign_ros2_control|IgnitionSystem", "Foxy to Humble", 2,
     "ign_ros2_control/IgnitionSystem became gz_ros2_control/GazeboSimSystem",
     "driven by ros2_control's controllers", False),
    ("description", _ROBOT, r"gz_ros2_control/GazeboSimSystem", "Humble and later", 2,
     "gz_ros2_control drives the new Gazebo", "driven by ros2_control's controllers", False),
    ("description", _ROBOT, r"<ros2_control\b", "ROS 2", 2,
     "<ros2_control> is ROS 2's", "driven by ros2_control's controllers", False),
    ("description", _ROBOT, r"<ros>\s*<", "Foxy to Humble", 2,
     "<ros> in a plug-in of Gazebo Classic is ROS 2's", "both are read", False),
    ("description", _ROBOT, r"libignition-gazebo|ignition::gazebo|ignition-gazebo-",
     "Gazebo Citadel to Fortress", 0, "ignition::gazebo became gz::sim in Garden",
     "both names are the same plug-in", False),
    ("description", _ROBOT, r"gz::sim|gz-sim-\w+-system", "Gazebo Garden and later", 0,
     "gz::sim is the name since Garden", "both names are the same plug-in", False),
    # -- code
    ("code", _CODE, r"roslib\.load_manifest", "Fuerte and before", 1,
     "load_manifest is rosbuild's", _AS_IT_IS, True),
    ("code", _CODE, r"(?m)^[ \t]*print[ \t]+[\"'%\w]", "Melodic and before", 1,
     "print without parentheses is Python 2's", "translated when it is started", False),
    ("code", _CODE, r"(?m)^[ \t]*(?:import|from) rospy\b", "ROS 1", 1, "rospy is ROS 1's",
     _AS_IT_IS, True),
    ("code", _CODE, r"(?m)^[ \t]*(?:import|from) rclpy\b", "ROS 2", 2, "rclpy is ROS 2's",
     _AS_IT_IS, True),
    ("code", _CPP, r"#include\s*[<\"]ros/ros\.h", "ROS 1", 1, "ros/ros.h is ROS 1's",
     "compiled when it is started", True),
    ("code", _CPP, r"#include\s*[<\"]rclcpp/", "ROS 2", 2, "rclcpp is ROS 2's",
     "compiled when it is started", True),
    # -- parameters
    ("parameters", _YAML, r"(?m)^\s*(?:TrajectoryPlannerROS|DWAPlannerROS|TebLocalPlannerROS):",
     "ROS 1", 1, "parameters of move_base", "read", False),
    ("parameters", _YAML, r"(?m)^\s*type:\s*[\"']?(?:effort|position|velocity)_controllers/Joint"
     r"(?!Group)", "ROS 1", 1, "controllers of ros_control", "read", False),
    ("parameters", _YAML, r"recoveries_server:", "Foxy to Galactic", 2,
     "recoveries_server became behavior_server in Humble", "read", False),
    ("parameters", _YAML, r"enable_stamped_cmd_vel:", "Jazzy and later", 2,
     "enable_stamped_cmd_vel came with Jazzy", "read", False),
    ("parameters", _YAML, r"ros__parameters:", "ROS 2", 2, "ros__parameters is ROS 2's", "read",
     True),
)  # fmt: skip


class Sign(NamedTuple):
    """A pattern and what it tells.

    Attributes:
        part: what kind of file: ``launch``, ``description``, ``code``, ``parameters``.
        endings: names of files that are looked at.
        pattern: searched for in the text without XML comments.
        written_for: distributions, in words.
        ros_version: 1 or 2, 0 when the sign tells nothing about it.
        why: what changed when.
        here: what Gazelle does with it.
        is_strict: the other generation cannot read such a file at all.
    """

    part: str
    endings: tuple[str, ...]
    pattern: re.Pattern[str]
    written_for: str
    ros_version: int
    why: str
    here: str
    is_strict: bool = False


SIGNS: tuple[Sign, ...] = tuple(
    Sign(part, endings, re.compile(pattern), for_, ros_version, why, here, strict)
    for part, endings, pattern, for_, ros_version, why, here, strict in _ROWS
)
_COLUMNS = ("part", "written for", "why", "what Gazelle does")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_FORMATS = {
    0: ("Fuerte and before", "manifest.xml is rosbuild's", "found by rospack's rules"),
    1: ("Groovy and later", "package.xml of format 1 is catkin's", "read"),
    2: ("Indigo and later", "package.xml of format 2", "read"),
    3: ("Melodic and later", "package.xml of format 3", "read"),
}


class VersionSign(NamedTuple):
    """A part of a package and its ROS.

    Attributes:
        part: ``package``, ``launch``, ``description``, ``code`` or ``parameters``.
        written_for: distributions, in words.
        ros_version: 1, 2, or 0 when it tells nothing about it.
        why: the sign, in words.
        here: what Gazelle does with it.
        spans: where the sign stands, once per file.
        is_strict: the other generation cannot use such a file.
    """

    part: str
    written_for: str
    ros_version: int
    why: str
    here: str
    spans: tuple[SourceSpan, ...]
    is_strict: bool


def version_signs(source: SourcePackage) -> tuple[VersionSign, ...]:
    """Return every sign found, the manifest's first; each with all its places."""
    found: dict[Sign, list[SourceSpan]] = {}
    for name in source.files:
        if "test" in PurePosixPath(name).parts or name == "package.xml":
            continue
        signs = [sign for sign in SIGNS if name.endswith(sign.endings)]
        text = _COMMENT.sub(_blanked, source.text(name)) if signs else ""
        for sign in signs:
            place = sign.pattern.search(text)
            if place is not None:
                found.setdefault(sign, []).append(_span(source, name, text, place))
    rows = (
        VersionSign(
            sign.part,
            sign.written_for,
            sign.ros_version,
            sign.why,
            sign.here,
            tuple(spans),
            sign.is_strict,
        )
        for sign, spans in found.items()
    )
    order = ("launch", "description", "code", "parameters")
    return (_of_manifest(source), *sorted(rows, key=lambda row: order.index(row.part)))


def ros_versions_section(source: SourcePackage) -> Section:
    """Return the table of a package's generations."""
    rows = tuple(
        (row.part, row.written_for, f"{row.why} ({_places(source, row.spans)})", row.here)
        for row in version_signs(source)
    )
    return Section("generations", f"{source.package.name}: written for", _COLUMNS, rows)


def check_ros_versions(source: SourcePackage, diagnostics: Diagnostics) -> None:
    """Report files of one generation in a package that is built for the other."""
    if _serves_both(source):
        return
    own = 2 if source.is_ros2 else 1
    seen: set[str] = set()
    for row in version_signs(source)[1:]:
        if not row.is_strict or row.ros_version in {0, own}:
            continue
        for span in row.spans:
            if span.file in seen:
                continue
            seen.add(span.file)
            _report_mixed(source, row, span, diagnostics)


def _report_mixed(
    source: SourcePackage, row: VersionSign, span: SourceSpan, diagnostics: Diagnostics
) -> None:
    name = span.file.removeprefix(f"{source.folder}/")
    other = "ROS 1" if row.ros_version == 1 else "ROS 2"
    own = "ROS 2" if row.ros_version == 1 else "ROS 1"
    text = f"'{name}' is written for {other} ({row.why}), the package is built for {own} "
    text += f"({source.build_type}); a real {own} cannot use the file"
    diagnostics.report("package.generations-mixed", text, span)


def _serves_both(source: SourcePackage) -> bool:
    """Tell a package that is written for both, by conditions in its manifest."""
    root = source.manifest
    if root is None:
        return source.package.format == 0
    if any("condition" in tag.attributes for tag in root.walk()):
        return True
    return source.build_type not in {"ament_cmake", "ament_python", "catkin"}


def _of_manifest(source: SourcePackage) -> VersionSign:
    package = source.package
    written_for, why, here = _FORMATS.get(package.format, _FORMATS[1])
    ros_version = 2 if source.is_ros2 else 1
    if source.is_ros2:
        written_for, why = "ROS 2", f"{why}, build type {source.build_type}"
    elif package.format:
        written_for, why = f"ROS 1 {written_for}", f"{why}, build type {source.build_type}"
    return VersionSign(
        "package", written_for, ros_version, why, here, (source.manifest_span,), True
    )


def _span(source: SourcePackage, name: str, text: str, place: re.Match[str]) -> SourceSpan:
    start = place.start() + len(place.group()) - len(place.group().lstrip())
    line = text.count("\n", 0, start) + 1
    column = start - text.rfind("\n", 0, start)
    length = len(place.group().strip().partition("\n")[0])
    return source.span(name, line, column, length)


def _places(source: SourcePackage, spans: tuple[SourceSpan, ...]) -> str:
    first = spans[0]
    name = first.file.removeprefix(f"{source.folder}/")
    shown = f"{name}:{first.line}" if first.line else name
    return f"{shown} and {len(spans) - 1} more" if len(spans) > 1 else shown


def _blanked(found: re.Match[str]) -> str:
    return re.sub(r"[^\n]", " ", found[0])
