"""Every reader of YAML that people write answers to YAML that would take it for ever."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple, cast

import pytest

from gazelle.bag.rosbag2.metadata import read_metadata, read_qos
from gazelle.bag.storage import BagError
from gazelle.cli.catkin import load_profile
from gazelle.cli.dynparam import _from_yaml as read_dynparam_file
from gazelle.cli.ros2.bag.convert import _outputs as read_output_bags
from gazelle.cli.ros2.param import _from_yaml as read_param_value
from gazelle.cli.ros_tool import ToolError
from gazelle.cli.rosparam import _file_text, _trees
from gazelle.cli.rostopic.pub import _file_documents as read_message_file
from gazelle.cli.text.fill_message import yaml_values, yaml_words
from gazelle.compat.command_modules.rosparam import RosParamException, load_str
from gazelle.compat.moveit_configs.parameter_files import load_yaml as load_moveit_yaml
from gazelle.compat.rclpy.parameter import get_parameter_value, parameter_dict_from_yaml_file
from gazelle.control.parameter_sources.ros2_controller_parameters import read_ros_arguments
from gazelle.control.parameter_sources.ros2_parameter_file import read_parameter_file
from gazelle.description.moveit.package_files import read_yaml
from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.launch_ros1.launched_nodes import parameter_spans
from gazelle.doctor.launch_ros2.xml_yaml_file import read_yaml_file
from gazelle.doctor.parameters.all_checks import check_parameter_file
from gazelle.documents.yaml import YamlError
from gazelle.errors import GazelleError, LaunchError
from gazelle.graph.names import parse_command_line
from gazelle.graph.ros2_arguments import parse_ros_arguments
from gazelle.launch.launch_config import LaunchConfig
from gazelle.launch.ros1.loader import load_launch_text
from gazelle.launch.ros2.actions.for_loop import ForEach
from gazelle.launch.ros2.error_diagnostics import diagnose
from gazelle.launch.ros2.frontend import Parser
from gazelle.launch.ros2.invalid_launch_file_error import InvalidLaunchFileError
from gazelle.launch.ros2.launch_context import LaunchContext
from gazelle.launch.ros2.launch_ros.parameter_descriptions import ParameterFile, ParameterValue
from gazelle.launch.ros2.nav2_common import RewrittenYaml
from gazelle.launch.ros2.utilities.type_utils import coerce_to_type
from gazelle.mapping.grids.map_yaml import read_map_file
from gazelle.nodes.controller_manager.spawner import controllers_in_file
from gazelle.nodes.ros_gz.bridge_config import read_file as read_bridge_rows
from gazelle.simulator.simulation_parameters import give_parameters
from gazelle.studio.errors import StudioError
from gazelle.studio.graph_view.message_forms import _yaml as read_form_field
from gazelle.studio.request_params import Params
from gazelle.studio.settings.rviz_files import open_rviz
from gazelle.workspace import Workspace

_MAX_SECONDS = 20.0
# What launch and launch_ros raise for mistakes of the user, as the originals do.
_OF_LAUNCH = (OSError, RuntimeError, TypeError, ValueError, YamlError, InvalidLaunchFileError)
_LARGE = frozenset({"too long"})  # nobody's parameters


def _aliases(levels: int) -> str:
    lines = ["a0: &a0 [x,x,x,x,x,x,x,x,x,x]"]
    lines += [f"a{n + 1}: &a{n + 1} [{','.join([f'*a{n}'] * 10)}]" for n in range(levels)]
    return "\n".join(lines)


def _merges(levels: int) -> str:
    lines = ["m0: &m0 {k0: 1}"]
    lines += [
        f"m{n}: &m{n} {{<<: [{','.join([f'*m{n - 1}'] * 10)}], k{n}: 1}}" for n in range(1, levels)
    ]
    return "\n".join(lines)


# What is not YAML, or YAML above a limit: whoever reads it has to say so.
BROKEN = {
    "aliases": _aliases(9).encode(),
    "merges": _merges(10).encode(),
    "brackets": b"[" * 100_000,
    "braces": b"{" * 100_000,
    "nested names": "".join(f"{' ' * n}a:\n" for n in range(200)).encode(),
    "nested items": b"- " * 50_000,
    "alias in itself": b"a: &a [1, *a]",
    "too long": b"a: 1\n" * 1_900_000,
    "tab": b"a:\n\tb: 1\n",
    "null": b"a: \0\n",
    "latin": b"a: caf\xe9\n",
    "open quote": b"a: '" + b"b" * 100_000,
}
# What is YAML, and not what anybody expects.
ODD = {
    "object": b'a: !!python/object/apply:os.system ["true"]',
    "decimal digits": b"a: 1" + b"0" * 5000,
    "hexadecimal digits": b"a: 0x" + b"f" * 5000,
    "octal digits": b"a: 0" + b"7" * 6000,
    "sexagesimal digits": b"a: 1" + b":59" * 20_000,
    "large number": b"a: 1" + b"0" * 400,
    "date": b"a: 2001-99-99",
    "number": b"3",
    "list": b"[1, {a: 2}, null]",
    "nothing": b"",
    "documents": b"a: 1\n---\nb: 2\n",
    "lists as names": b"? [a]\n: b\n",
    "numbers as names": b"1: {2: 3}\nnull: 4\n",
    "merge of a number": b"<<: 3\n",
    "set": b"a: !!set {b, c}\n",
}


class _Reader(NamedTuple):
    """A reader.

    Attributes:
        read: reads a file, and returns diagnostics if it fills some.
        errors: what it raises for mistakes of the user.
        tells: it says what is wrong with a text; others take such a text for a plain word.
        takes: what of `BROKEN` is nothing wrong for it.
    """

    read: Callable[[Path], object]
    errors: tuple[type[Exception], ...] = (GazelleError,)
    tells: bool = True
    takes: frozenset[str] = frozenset()


def _text(path: Path) -> str:
    """Return a text as the shell hands it over."""
    return path.read_bytes().decode("utf-8", "surrogateescape")


def _reported(read: Callable[[Path, Diagnostics], object]) -> Callable[[Path], Diagnostics]:
    def run(path: Path) -> Diagnostics:
        diagnostics = Diagnostics()
        read(path, diagnostics)
        return diagnostics

    return run


def _of_launch(read: Callable[[Path], object]) -> Callable[[Path], Diagnostics]:
    """Return a reader of a launch of ROS 2, whose errors are told with a code of the catalogue."""

    def run(path: Path) -> Diagnostics:
        diagnostics = Diagnostics()
        try:
            read(path)
        except _OF_LAUNCH as error:
            assert not isinstance(error, RecursionError)
            for found in diagnose(error):
                diagnostics.add(found)
        return diagnostics

    return run


def _workspace(path: Path) -> Workspace:
    return Workspace.discover(environ={}, cwd=path.parent)


def _xacro(path: Path, diagnostics: Diagnostics) -> None:
    file = path.parent / "a.xacro"
    file.write_text(
        f'<a xmlns:xacro="http://www.ros.org/wiki/xacro" b="${{xacro.load_yaml(\'{path}\')}}"/>',
        encoding="utf-8",
    )
    expand_xacro(file, workspace=_workspace(path), diagnostics=diagnostics)


def _roslaunch(path: Path, diagnostics: Diagnostics) -> None:
    text = f"<launch><rosparam command='load' file='{path}'/></launch>"
    load_launch_text(text, {}, workspace=_workspace(path), diagnostics=diagnostics)


def _places(path: Path) -> None:
    config = LaunchConfig()
    config.yaml_files[SourceSpan("a.launch", 1)] = (str(path), "/")
    parameter_spans(config)


def _metadata(path: Path) -> None:
    (path.parent / "metadata.yaml").write_bytes(path.read_bytes())
    read_metadata(path.parent)


def _catkin(path: Path) -> None:
    folder = path.parent / ".catkin_tools" / "profiles" / "default"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "config.yaml").write_bytes(path.read_bytes())
    load_profile(path.parent)


def _rclpy(path: Path) -> None:
    words = ["--ros-args", "--params-file", str(path), "-p", f"a:={_text(path)}"]
    parse_ros_arguments(words).parameters("/robot/talker")


def _frontend(path: Path) -> None:
    root, parser = Parser.load(str(path))
    parser.parse_description(root)


READERS = {
    "parameter file": _Reader(_reported(read_parameter_file)),
    "MoveIt's file": _Reader(_reported(read_yaml)),
    "doctor": _Reader(_reported(lambda p, d: check_parameter_file(p, diagnostics=d)), takes=_LARGE),
    "doctor, ROS 1": _Reader(
        _reported(lambda p, d: check_parameter_file(p, diagnostics=d, ros_version=1)), takes=_LARGE
    ),
    "doctor's launch file": _Reader(
        _reported(lambda p, d: read_yaml_file(p, {}, workspace=_workspace(p), diagnostics=d)),
        takes=_LARGE,
    ),
    "doctor's places": _Reader(_places, tells=False),
    # Its own budget counts what a list prints, and one that holds itself prints as [...].
    "xacro": _Reader(_reported(_xacro), takes=frozenset({"alias in itself"})),
    "rosparam of roslaunch": _Reader(_reported(_roslaunch)),
    "map": _Reader(_reported(read_map_file)),
    "metadata of a bag": _Reader(_metadata, (BagError,)),
    "QoS of a bag": _Reader(lambda p: read_qos(_text(p)), tells=False),
    "ros2 bag convert": _Reader(read_output_bags, (BagError,)),
    "parameters of a simulation": _Reader(
        lambda p: give_parameters(p, cast(Any, _Store()), cast(Any, None))
    ),
    "controller_spawner": _Reader(lambda p: controllers_in_file(str(p)), (LaunchError,)),
    "ros_gz_bridge": _Reader(read_bridge_rows, (LaunchError,)),
    "words of a node, ROS 1": _Reader(
        lambda p: parse_command_line([f"_a:={_text(p)}"]), tells=False
    ),
    "words of a node, ROS 2": _Reader(
        lambda p: read_ros_arguments(["--ros-args", "-p", f"a:={_text(p)}"]), tells=False
    ),
    "rclpy's words": _Reader(_rclpy, tells=False),
    "rclpy's value": _Reader(lambda p: get_parameter_value(_text(p)), tells=False),
    "rclpy's file": _Reader(lambda p: parameter_dict_from_yaml_file(str(p)), (Exception,)),
    "moveit_configs_utils": _Reader(load_moveit_yaml),
    "rosparam in Python": _Reader(lambda p: load_str(_text(p), str(p), "/"), (RosParamException,)),
    "rosparam load": _Reader(lambda p: list(_trees(_file_text(p), str(p), "/")), (ToolError,)),
    "dynparam load": _Reader(lambda p: read_dynparam_file(str(p)), (ToolError,)),
    "rostopic pub -f": _Reader(lambda p: read_message_file(str(p)), (ToolError,)),
    "rostopic pub": _Reader(lambda p: yaml_words([_text(p)]), (ToolError,)),
    "ros2 topic pub": _Reader(lambda p: yaml_values(_text(p)), (ToolError,)),
    "ros2 param set": _Reader(lambda p: read_param_value(_text(p)), (ToolError,)),
    "catkin": _Reader(_catkin),
    ".rviz": _Reader(lambda p: open_rviz(Params("rviz.open", {"path": str(p)}))),
    "form of the page": _Reader(lambda p: read_form_field(_text(p), "a."), (StudioError,)),
    "launch file": _Reader(_of_launch(_frontend)),
    "RewrittenYaml": _Reader(
        _of_launch(lambda p: RewrittenYaml(str(p), {}).perform(LaunchContext()))
    ),
    "ParameterFile": _Reader(
        _of_launch(lambda p: ParameterFile(str(p), allow_substs=True).evaluate(LaunchContext()))
    ),
    "ParameterValue": _Reader(
        _of_launch(lambda p: ParameterValue(_text(p)).evaluate(LaunchContext())), tells=False
    ),
    "ForEach": _Reader(
        _of_launch(lambda p: ForEach(_text(p), function=lambda **_: []).execute(LaunchContext()))
    ),
    "value of a type": _Reader(
        _of_launch(lambda p: coerce_to_type(_text(p), list[int])), (ValueError,), tells=False
    ),
}

# Those that ask for a file themselves.
_OF_FILES = (
    "parameter file",
    "MoveIt's file",
    "doctor",
    "doctor's launch file",
    "rosparam of roslaunch",
    "map",
    "ros2 bag convert",
    "parameters of a simulation",
    "controller_spawner",
    "ros_gz_bridge",
    "dynparam load",
    "launch file",
    "RewrittenYaml",
    "ParameterFile",
    ".rviz",
)


class _Store:
    def set(self, name: str, value: object) -> None:
        pass


def _said(reader: _Reader, path: Path) -> str:
    begin = time.thread_time()
    try:
        found = reader.read(path)
    except reader.errors as error:
        said = str(error) or type(error).__name__
    else:
        said = "\n".join(map(str, found)) if isinstance(found, Diagnostics) else ""
    assert time.thread_time() - begin < _MAX_SECONDS
    return said


@pytest.mark.parametrize("bomb", BROKEN)
@pytest.mark.parametrize("name", READERS)
def test_what_is_no_yaml_is_told_by_the_reader_itself(name: str, bomb: str, tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    path.write_bytes(BROKEN[bomb])
    said = _said(READERS[name], path)
    assert said or not READERS[name].tells or bomb in READERS[name].takes


@pytest.mark.parametrize("text", ODD)
@pytest.mark.parametrize("name", READERS)
def test_odd_yaml_is_a_value_or_an_error_of_the_reader(
    name: str, text: str, tmp_path: Path
) -> None:
    path = tmp_path / "a.yaml"
    path.write_bytes(ODD[text])
    _said(READERS[name], path)


@pytest.mark.skipif(os.name == "nt", reason="there are no devices in folders")
@pytest.mark.parametrize("name", _OF_FILES)
def test_a_file_without_end_is_refused(name: str) -> None:
    assert "it is a device, not a file" in _said(READERS[name], Path("/dev/zero"))
