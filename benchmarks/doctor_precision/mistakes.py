"""Kinds of mistakes that people make in robot packages, and where each one stands.

A kind says which files it can be made in, what is looked for there, and what a person writes
instead. The place that a finding has to name is the line that was written wrongly; where something
was left out, the element that it is missing from.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

__all__ = ["MISTAKES", "Mistake", "Mutant"]

_Change = Callable[[re.Match[str]], str]
_ROBOT = r"\.(xacro|urdf)$|urdf/.*\.xml$"
_XML = r"\.(xacro|urdf|world|sdf|launch)$|urdf/.*\.xml$"
_LAUNCH1 = r"\.launch$"
_LAUNCH2 = r"\.launch\.py$"
_YAML = r"\.yaml$"
_CONTROL = r"(control|joints|diffdrive|head|arm|gripper).*\.yaml$"
_WORLD = r"\.(world|sdf)$"
_NODE = r"(?<!launch)(?<!setup)\.py$"


class Mutant(NamedTuple):
    """One mistake made at one place.

    Attributes:
        mistake: its kind.
        file: the file, relative to the workspace.
        text: what is in it now.
        lines: lines of it that a finding may name.
    """

    mistake: str
    file: Path
    text: str
    lines: frozenset[int]


class Mistake(NamedTuple):
    """One kind.

    Attributes:
        name: of the kind.
        files: pattern of the paths of files where it is made.
        wrong: pattern of what is changed.
        change: gives what is written instead.
        parent: the finding may name the element around as well: something is left out.
        around: pattern of lines that it may name, too, where there are no elements.
        needs: pattern that the file holds, where the mistake is none without it.
        lacks: pattern that the file does not hold.
    """

    name: str
    files: str
    wrong: str
    change: _Change
    parent: bool = False
    around: str = ""
    needs: str = ""
    lacks: str = ""

    def mutants(self, file: Path, text: str) -> Iterator[Mutant]:
        """Make it at each place of a file."""
        if not re.search(self.files, file.as_posix()):
            return
        if (self.needs and not re.search(self.needs, text)) or (
            self.lacks and re.search(self.lacks, text)
        ):
            return
        bare = _without_comments(text, file)
        for match in re.finditer(self.wrong, bare, re.MULTILINE | re.DOTALL):
            said = self.change(match)
            # Comments in it are blank in the pattern's text, and stay as they are.
            changed = text[: match.start()] + said + text[match.end() :]
            if changed != text:
                lines = self._lines(text, match, file.suffix not in {".py", ".yaml", ".txt"})
                yield Mutant(self.name, file, changed, lines)

    def _lines(self, text: str, match: re.Match[str], is_xml: bool) -> frozenset[int]:
        groups = match.re.groupindex
        at = match.start("w") if "w" in groups else match.start()
        line = text.count("\n", 0, at + len(text[at:]) - len(text[at:].lstrip("\n"))) + 1
        lines = {line}
        if "opened" in groups:
            return frozenset({text.count("\n", 0, match.start("opened")) + 1})
        if is_xml:
            # A tag of several lines is told where it begins.
            opened = text.rfind("<", 0, at + 1)
            if ">" not in text[opened:at]:
                lines.add(text.count("\n", 0, opened) + 1)
        if self.parent:
            lines |= _parents(text, at)
        if self.around:
            lines |= {
                text.count("\n", 0, found.start()) + 1 for found in re.finditer(self.around, text)
            }
        return frozenset(lines)


def _without_comments(text: str, file: Path) -> str:
    """Blank out comments, so that nobody is asked to find a mistake in one."""
    pattern = r"#[^\n]*" if file.suffix in {".py", ".yaml"} else r"<!--.*?-->"
    return re.sub(pattern, lambda match: re.sub(r"[^\n]", " ", match[0]), text, flags=re.DOTALL)


def _parents(text: str, at: int) -> set[int]:
    """Return the lines of the tags that are open at a place, the innermost two."""
    open_tags: list[tuple[str, int]] = []
    for match in re.finditer(r"<(/?)([\w:]+)((?:[^<>\"']|\"[^\"]*\"|'[^']*')*?)(/?)>", text[:at]):
        if match[1]:
            while open_tags and open_tags.pop()[0] != match[2]:
                pass
        elif not match[4]:
            open_tags.append((match[2], text.count("\n", 0, match.start()) + 1))
    return {line for _, line in open_tags[-2:]}


def _typo(word: str) -> str:
    """Swap two letters in the middle of a word, as fingers do."""
    places = [
        at
        for at in range(1, len(word) - 1)
        if word[at].isalpha() and word[at + 1].isalpha() and word[at] != word[at + 1]
    ]
    if not places:
        return word + "x"
    at = places[len(places) // 2]
    return word[:at] + word[at + 1] + word[at] + word[at + 2 :]


def _misspelt(match: re.Match[str]) -> str:
    """Misspell the group called ``w``."""
    begin, end = match.start("w") - match.start(), match.end("w") - match.start()
    return match[0][:begin] + _typo(match["w"]) + match[0][end:]


def _both_misspelt(match: re.Match[str]) -> str:
    """Misspell ``w`` wherever it stands in the match: a tag and its end."""
    return match[0].replace(match["w"], _typo(match["w"]))


def _to(text: str) -> _Change:
    """Write this in place of the group called ``w``."""

    def change(match: re.Match[str]) -> str:
        begin, end = match.start("w") - match.start(), match.end("w") - match.start()
        return match[0][:begin] + text + match[0][end:]

    return change


def _gone(_match: re.Match[str]) -> str:
    return ""


def _times(factor: float) -> _Change:
    def change(match: re.Match[str]) -> str:
        return _to(f"{float(match['w']) * factor:g}")(match)

    return change


def _swapped(match: re.Match[str]) -> str:
    return f'lower="{match["b"]}" upper="{match["a"]}"'


def _negative(match: re.Match[str]) -> str:
    return _to(f"-{match['w']}")(match)


MISTAKES = (
    # XML as such.
    Mistake("xml.quote-forgotten", _XML, r'(name|value|xyz|link)="[\w ./-]+(?P<w>")', _to("")),
    Mistake("xml.slash-forgotten", _XML, r"<(mass|origin|axis|box|parent|child)\b[^<>]*(?P<w>/)>",
            _to("")),
    Mistake("xml.end-forgotten", _XML,
            r"(?P<opened>)<(visual|collision|inertial|joint|link|node|include|sensor|model)\b"
            r"[^<>]*(?<!/)>(?:(?!<\2\b).)*?(?P<w></\2>)", _to("")),
    Mistake("xml.end-misspelt", _XML, r"</(?P<w>visual|collision|geometry|link|node|model)>",
            _misspelt),
    Mistake("xml.ampersand", _LAUNCH1, r'value="(?!true|false)(?P<w>[a-z_]+)"', _to("a & b")),
    Mistake("urdf.tag-misspelt", _ROBOT,
            r"<(?P<w>visual|collision|inertial|geometry)>.*?</(?P=w)>", _both_misspelt),
    Mistake("urdf.attribute-misspelt", _ROBOT,
            r"<(?:cylinder|sphere|box|mass|axis|child|parent)\s+(?P<w>\w+)=", _misspelt),
    # Links and joints.
    Mistake("urdf.child-misspelt", _ROBOT, r'<child\s+link="(?P<w>[\w]+)"', _misspelt),
    Mistake("urdf.parent-misspelt", _ROBOT, r'<parent\s+link="(?P<w>[\w]+)"', _misspelt),
    Mistake("urdf.joint-type-misspelt", _ROBOT,
            r'<joint\s[^<>]*type="(?P<w>continuous|revolute|prismatic|fixed)"', _misspelt),
    Mistake("urdf.joint-type-missing", _ROBOT,
            r'<joint\s[^<>]*(?P<w>\s*type="(?:continuous|revolute|prismatic|fixed)")', _to("")),
    Mistake("urdf.limit-missing", _ROBOT,
            r'type="(?:revolute|prismatic)">(?:(?!</joint>).)*?(?P<w><limit\b[^<>]*/>)', _to(""),
            parent=True),
    Mistake("urdf.limits-swapped", _ROBOT,
            r'lower="(?P<a>[-\d.]+)"\s+upper="(?P<b>[-\d.]+)"', _swapped),
    Mistake("urdf.limit-effort-missing", _ROBOT, r'<limit\b[^<>]*(?P<w>\s+effort="[^"]*")',
            _to("")),
    Mistake("urdf.axis-zero", _ROBOT, r'<axis\s+xyz="(?P<w>[^"]*)"', _to("0 0 0")),
    Mistake("urdf.wheel-axis-wrong", _ROBOT,
            r'wheel_joint"(?:(?!</joint>).)*?<axis\s+xyz="(?P<w>0 -?1 0)"', _to("1 0 0")),
    Mistake("urdf.link-twice", _ROBOT,
            r'<link name="(?P<o>\w+)"(?:(?!<link ).)*<link name="(?P<w>\w+)"',
            lambda match: _to(match["o"])(match)),
    Mistake("urdf.parent-is-child", _ROBOT,
            r'<parent link="(?P<w>[\w]+)"/>\s*<child link="(?P<c>\w+)"',
            lambda match: _to(match["c"])(match), parent=True),
    # Numbers.
    Mistake("number.comma", _ROBOT, r'(?:radius|length|value|ixx)="\d+(?P<w>\.)\d+"', _to(",")),
    Mistake("number.two-points", _ROBOT, r'(?:radius|length|value|ixx)="\d+(?P<w>\.)\d+"',
            _to(".0.")),
    Mistake("number.two-of-three", _ROBOT,
            r'(?:xyz|size)="[-\d.]+ [-\d.]+(?P<w> [-\d.]+)"', _to("")),
    Mistake("number.degrees", _ROBOT, r'rpy="(?P<w>\$\{pi/2\}|1\.57\d*)', _to("90")),
    Mistake("inertia.mass-zero", _ROBOT, r'<mass\s+value="(?P<w>[\d.]+)"', _to("0")),
    Mistake("inertia.mass-negative", _ROBOT, r'<mass\s+value="(?P<w>[\d.]+)"', _negative),
    Mistake("inertia.missing", _ROBOT,
            r"(?P<w><inertial>.*?</inertial>|<xacro:\w+_inertial? [^<>]*/>)", _to(""),
            parent=True),
    Mistake("inertia.impossible", _ROBOT, r'<inertia\s[^<>]*i(?:xx|yy|zz)="(?P<w>[\d.e-]+)"',
            _times(50)),
    Mistake("inertia.negative", _ROBOT, r'<inertia\s[^<>]*i(?:xx|yy|zz)="(?P<w>[\d.e-]+)"',
            _negative),
    Mistake("size.millimetres", _ROBOT, r'(?:radius|length)="(?P<w>0?\.\d+)"', _times(1000)),
    # Xacro.
    Mistake("xacro.macro-misspelt", _ROBOT,
            r"<xacro:(?!macro|include|property|arg|if|unless|insert_block)(?P<w>\w+)[^<>]*/>",
            _misspelt),
    Mistake("xacro.argument-missing", _ROBOT,
            r'<xacro:(?!macro|include|property|arg|if|unless|insert)\w+\s[^<>]*?'
            r'(?P<w>\b[a-z]\w*="[^"]*")', _to("")),
    Mistake("xacro.argument-misspelt", _ROBOT,
            r"<xacro:(?!macro|include|property|arg|if|unless|insert)\w+\s[^<>]*?(?P<w>\b[a-z]\w+)=",
            _misspelt),
    Mistake("xacro.property-misspelt", _ROBOT, r"\$\{(?:\d \* )?(?P<w>[a-z]\w{3,})\W", _misspelt),
    Mistake("xacro.brace-forgotten", _ROBOT, r"\$\{[^{}]*(?P<w>\})", _to("")),
    Mistake("xacro.include-misspelt", _ROBOT,
            r'<xacro:include\s+filename="[^"]*?(?P<w>\w+)\.(?:urdf\.)?\w+"', _misspelt),
    Mistake("xacro.namespace-missing", _ROBOT, r'<robot[^>]*(?P<w>\s+xmlns:xacro="[^"]*")',
            _to(""), parent=True, needs=r"<xacro:"),
    Mistake("urdf.material-misspelt", _ROBOT, r'<material\s+name="(?P<w>\w+)"\s*/>', _misspelt),
    # Files.
    Mistake("mesh.file-misspelt", _ROBOT, r'filename="package://[^"]*?(?P<w>\w+)\.(?:dae|stl|STL)"',
            _misspelt),
    Mistake("mesh.package-misspelt", _ROBOT, r'filename="package://(?P<w>\w+)/', _misspelt),
    Mistake("mesh.folder-wrong", _ROBOT, r'filename="package://\w+/(?P<w>meshes)/',
            _to("mesh")),
    # What Gazebo is told.
    Mistake("gazebo.reference-misspelt", _ROBOT, r'<gazebo\s+reference="(?P<w>[\w]+)"', _misspelt),
    Mistake("plugin.file-misspelt", _ROBOT, r'filename="lib(?P<w>\w+)\.so"', _misspelt),
    Mistake("plugin.tag-misspelt", _ROBOT,
            r"<(?P<w>leftJoint|rightJoint|wheelSeparation|commandTopic|odometryFrame|topicName|"
            r"frameName|cameraName|robotNamespace|left_joint|right_joint|wheel_separation)>.*?"
            r"</(?P=w)>", _both_misspelt),
    Mistake("plugin.joint-misspelt", _ROBOT,
            r"<(?:left_?[jJ]oint|right_?[jJ]oint|left_front_joint)>(?P<w>\w+)<", _misspelt),
    Mistake("plugin.frame-misspelt", _ROBOT, r"<(?:frameName|frame_name)>(?P<w>\w+)<", _misspelt),
    Mistake("plugin.control-forgotten", _ROBOT,
            r'(?P<w><plugin[^<>]*libgazebo_ros_control\.so"(?:/>|[^<>]*>.*?</plugin>))', _to(""),
            parent=True),
    Mistake("sensor.type-misspelt", _ROBOT, r'<sensor\s[^<>]*type="(?P<w>\w+)"', _misspelt),
    Mistake("gazebo.number", _XML, r"<(?:update_rate|samples|width|mu1?)>(?P<w>[\d.]+)<",
            _to("ten")),
    # Transmissions and ros2_control.
    Mistake("transmission.joint-misspelt", _ROBOT,
            r'<transmission.*?<joint\s+name="(?P<w>[\w]+)"', _misspelt),
    Mistake("transmission.interface-misspelt", _ROBOT,
            r"<hardwareInterface>(?:hardware_interface/)?(?P<w>\w+)<", _misspelt),
    Mistake("transmission.type-misspelt", _ROBOT, r"<type>transmission_interface/(?P<w>\w+)<",
            _misspelt),
    Mistake("ros2-control.interface-misspelt", _ROBOT,
            r'<(?:command|state)_interface\s+name="(?P<w>\w+)"', _misspelt),
    Mistake("ros2-control.joint-misspelt", _ROBOT,
            r'<ros2_control.*?<joint\s+name="(?P<w>[\w]+)"', _misspelt),
    Mistake("ros2-control.plugin-misspelt", _ROBOT,
            r"<hardware>\s*<plugin>[\w]+/(?P<w>\w+)<", _misspelt),
    # Launch files of ROS 1.
    Mistake("launch.package-misspelt", _LAUNCH1, r'<node\s[^<>]*pkg="(?P<w>\w+)"', _misspelt),
    Mistake("launch.type-misspelt", _LAUNCH1, r'<node\s[^<>]*type="(?P<w>\w+)', _misspelt),
    Mistake("launch.type-missing", _LAUNCH1, r'<node\s[^<>]*(?P<w>\s+type="[^"]*")', _to("")),
    Mistake("launch.find-misspelt", _LAUNCH1, r"\$\(find (?P<w>\w+)\)", _misspelt),
    Mistake("launch.included-file-misspelt", _LAUNCH1,
            r'<include\s+file="[^"]*/(?P<w>\w+)\.launch', _misspelt),
    Mistake("launch.arg-misspelt", _LAUNCH1, r"\$\(arg (?P<w>\w+)\)", _misspelt),
    Mistake("launch.included-arg-misspelt", _LAUNCH1,
            r'<include\s(?:(?!</include>).)*?<arg\s+name="(?P<w>\w+)"', _misspelt),
    Mistake("launch.description-misspelt", _LAUNCH1, r"-param (?P<w>robot_description)",
            _misspelt),
    Mistake("launch.xacro-as-text", _LAUNCH1,
            r'command="(?P<w>\$\(find xacro\)/xacro )\$\(find \w+\)[^" ]*"',
            lambda match: f'textfile="{match[0].partition("/xacro ")[2]}'),
    Mistake("launch.controller-misspelt", _LAUNCH1,
            r'type="(?:controller_manager|spawner)"[^<>]*args="(?:spawn )?[^"]*?'
            r'(?P<w>\w+controller)', _misspelt),
    Mistake("launch.file-misspelt", _LAUNCH1, r'(?:file|value|command)="[^"]*/(?P<w>\w+)\.'
            r'(?:yaml|world|urdf\.xacro|xacro)', _misspelt),
    Mistake("launch.tag-misspelt", _LAUNCH1, r"<(?P<w>param|rosparam|node|arg)\s[^<>]*/>",
            _misspelt),
    Mistake("launch.attribute-misspelt", _LAUNCH1, r"<(?:param|node|arg)\s+(?P<w>name)=",
            _misspelt),
    # Launch files of ROS 2.
    Mistake("launch2.package-misspelt", _LAUNCH2, r'package="(?P<w>\w+)"', _misspelt),
    Mistake("launch2.package-misspelt-single", _LAUNCH2, r"package='(?P<w>\w+)'", _misspelt),
    Mistake("launch2.executable-misspelt", _LAUNCH2, r"executable=[\"'](?P<w>\w+)", _misspelt),
    Mistake("launch2.share-misspelt", _LAUNCH2,
            r"(?:get_package_share_directory|FindPackageShare)\([\"'](?P<w>\w+)", _misspelt),
    Mistake("launch2.file-misspelt", _LAUNCH2,
            r"[\"'][\w/]*?(?P<w>\w+)\.(?:yaml|world|urdf\.xacro|xacro|srdf|rviz|launch\.py)[\"']",
            _misspelt),
    Mistake("launch2.configuration-misspelt", _LAUNCH2,
            r"LaunchConfiguration\([\"'](?P<w>\w+)", _misspelt),
    Mistake("launch2.comma-forgotten", _LAUNCH2, r"\)(?P<w>,)\n\s+(?:Node|Include|Declare)",
            _to("")),
    Mistake("launch2.argument-name", _LAUNCH2, r"\b(?P<w>executable|parameters|arguments)=",
            _misspelt),
    Mistake("launch2.controller-misspelt", _LAUNCH2,
            r"spawner.*?arguments=\[[^\]]*?[\"'](?P<w>\w+(?:controller|broadcaster))", _misspelt),
    # Parameters.
    Mistake("yaml.tab", _YAML, r"^(?P<w> +)\w+:", _to("\t")),
    Mistake("yaml.space-forgotten", _YAML, r"^\s+\w+:(?P<w> )[\w.\"]", _to("")),
    Mistake("yaml.colon-forgotten", _YAML, r"^\s+\w+(?P<w>:)\s*$", _to("")),
    Mistake("yaml.bracket-forgotten", _YAML, r"\[[^\[\]]*(?P<w>\])", _to("")),
    Mistake("yaml.joint-misspelt", _YAML, r"(?P<w>\w+_joint)\b", _misspelt),
    Mistake("yaml.controller-type-misspelt", _YAML, r"type:\s*\"?[\w]+/(?P<w>\w+)", _misspelt),
    Mistake("yaml.key-misspelt", _CONTROL,
            r"^\s+(?P<w>type|joints|joint|publish_rate|left_wheel|right_wheel|command_interfaces|"
            r"state_interfaces|wheel_separation|update_rate|left_wheel_names):", _misspelt),
    Mistake("yaml.ros-parameters-missing", _YAML, r"^(?P<w>\s+ros__parameters:)$",
            _to("  parameters:")),
    Mistake("yaml.interface-misspelt", _YAML, r"^\s+- (?P<w>position|velocity|effort)$",
            _misspelt),
    # SRDF.
    Mistake("srdf.joint-misspelt", r"\.srdf$", r'<joint\s+name="(?P<w>\w+)"', _misspelt),
    Mistake("srdf.link-misspelt", r"\.srdf$", r'link1="(?P<w>\w+)"', _misspelt),
    Mistake("srdf.group-misspelt", r"\.srdf$", r'<group_state\s[^<>]*group="(?P<w>\w+)"',
            _misspelt),
    # Worlds.
    Mistake("world.model-misspelt", _WORLD, r"<uri>model://(?P<w>\w+)</uri>", _misspelt),
    Mistake("world.pose-short", _WORLD, r"<pose>[-\d.]+ [-\d.]+ [-\d.]+(?P<w> [^<]*)</pose>",
            _to("")),
    Mistake("world.plugin-misspelt", _WORLD, r'filename="lib(?P<w>\w+)\.so"', _misspelt),
    Mistake("world.geometry-misspelt", _WORLD, r"<(?P<w>box|cylinder|sphere)>.*?</(?P=w)>",
            _both_misspelt),
    # The package.
    Mistake("package.dependency-misspelt", r"package\.xml$",
            r"<(?:exec_|run_|build_)?depend>(?P<w>\w+)<", _misspelt),
    Mistake("package.dependency-missing", r"package\.xml$",
            r"\n\s*(?P<w><(?:exec_|run_)?depend>(?:xacro|gazebo_ros|rospy|rclpy|geometry_msgs)"
            r"</\w+>)", _to(""), parent=True),
    Mistake("package.name-misspelt", r"package\.xml$", r"<name>(?P<w>\w+)<", _misspelt),
    Mistake("package.buildtool-wrong", r"package\.xml$", r"<buildtool_depend>(?P<w>catkin)<",
            _to("ament_cmake")),
    Mistake("install.folder-missing", r"CMakeLists\.txt$",
            r"install\(DIRECTORY[^)]*?(?P<w>\b(?:launch|urdf|config|worlds)\b)", _to("")),
    Mistake("install.data-files-missing", r"setup\.py$",
            r"^(?P<w>\s*\([^\n]*(?:launch|urdf|config|worlds)[^\n]*glob[^\n]*)", _to(""),
            around=r"data_files"),
    Mistake("setup.entry-point-misspelt", r"setup\.py$", r"=\s*\w+\.(?P<w>\w+):main", _misspelt),
    # Nodes in Python.
    Mistake("node.message-misspelt", _NODE, r"from \w+\.msg import (?P<w>\w+)", _misspelt),
    Mistake("node.package-misspelt", _NODE, r"from (?P<w>\w+_msgs)\.(?:msg|srv) import", _misspelt),
    Mistake("node.topic-misspelt", _NODE,
            r"(?:Publisher|Subscriber|create_publisher|create_subscription)\([^\"')]*[\"']"
            r"/?(?P<w>cmd_vel|scan|odom|joint_states|imu)", _misspelt),
    Mistake("node.colon-forgotten", _NODE, r"^\s*(?:def|class|if|for)\s[^\n]*(?P<w>:)$", _to("")),
    Mistake("node.indentation", _NODE, r"^(?P<w>    )(?:return|rospy|self)\b", _to("   ")),
)  # fmt: skip
