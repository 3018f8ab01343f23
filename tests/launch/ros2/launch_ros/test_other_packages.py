"""What ros_gz and Nav2 add to launch: each name of theirs, executed."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from gazelle.launch.ros2 import LaunchContext, LaunchDescription, actions, nav2_common, ros_gz
from gazelle.launch.ros2.conditions import IfCondition
from gazelle.launch.ros2.frontend import Parser
from gazelle.launch.ros2.substitutions import LaunchConfiguration
from gazelle.launch.ros2.utilities import perform_substitutions

_YAML = """
amcl: {ros__parameters: {use_sim_time: false, scan: {topic: a, rates: [1, 2]}}}
planner: {ros__parameters: {use_sim_time: false, frame: map}}
"""


@pytest.fixture
def params(tmp_path: Path) -> str:
    """A file of parameters of two nodes."""
    file = tmp_path / "params.yaml"
    file.write_text(_YAML)
    return str(file)


def _rewritten(params: str, context: LaunchContext, *words: Any, **options: Any) -> Any:
    path = nav2_common.RewrittenYaml(params, *words, **options).perform(context)
    assert path != params
    return yaml.safe_load(Path(path).read_text())


def RewrittenYaml(params: str, context: LaunchContext) -> None:
    context.launch_configurations.update(sim="true", robot="r1", rate="7", half="0.5")
    rewrites: dict[str, Any] = {
        "use_sim_time": LaunchConfiguration("sim"),
        "amcl.ros__parameters.scan.topic": [LaunchConfiguration("robot"), "/scan"],
        "amcl.ros__parameters.scan.rates.1": LaunchConfiguration("rate"),
        "amcl.ros__parameters.added.half": LaunchConfiguration("half"),
        "planner.unknown": "is not added",
    }
    found = _rewritten(
        params, context, rewrites, root_key="r1", key_rewrites={"planner": "p"}, convert_types=True
    )
    amcl = {"use_sim_time": True, "scan": {"topic": "r1/scan", "rates": [1, 7]}}
    assert found == {
        "r1": {
            "amcl": {"ros__parameters": {**amcl, "added": {"half": 0.5}}},
            "p": {"ros__parameters": {"use_sim_time": True, "frame": "map"}},
        }
    }
    plain = _rewritten(params, context, {"frame": LaunchConfiguration("rate")}, root_key="")
    assert plain["planner"]["ros__parameters"]["frame"] == "7"


def ReplaceString(params: str, context: LaunchContext) -> None:
    made = nav2_common.ReplaceString(params, {"map": LaunchConfiguration("robot")})
    context.launch_configurations.update(robot="r1", no="false")
    assert "frame: r1" in Path(made.perform(context)).read_text()
    off = nav2_common.ReplaceString(params, {"map": "x"}, IfCondition(LaunchConfiguration("no")))
    assert off.perform(context) == params


def HasNodeParams(params: str, context: LaunchContext) -> None:
    found = [nav2_common.HasNodeParams(params, name).perform(context) for name in ("amcl", "acml")]
    assert found == ["True", "False"]


def LaunchConfigAsBool(params: str, context: LaunchContext) -> None:
    context.launch_configurations.update(a="Yes", b="1", c="off")
    found = [nav2_common.LaunchConfigAsBool(name).perform(context) for name in "abc"]
    assert found == ["True", "True", "False"]


def ParseMultiRobotPose(params: str, context: LaunchContext) -> None:
    text = "r1={x: 1.0, yaw: 1.57}; r2={y: -2}"
    context.launch_configurations["robots"] = text
    found = nav2_common.ParseMultiRobotPose(LaunchConfiguration("robots")).perform(context)
    zero = {"x": 0.0, "y": 0.0, "z": 0.0, "roll": 0.0, "pitch": 0.0, "yaw": 0.0}
    assert found == {"r1": {**zero, "x": 1.0, "yaw": 1.57}, "r2": {**zero, "y": -2}}
    sys.argv.append(f"robots:={text}")
    try:
        assert nav2_common.ParseMultiRobotPose("robots").value() == found
    finally:
        sys.argv.pop()
    assert nav2_common.ParseMultiRobotPose("robots").value() == {}


@pytest.mark.parametrize("name", nav2_common.__all__)
def test_substitution_of_nav2(name: str, params: str, context: LaunchContext) -> None:
    globals()[name](params, context)
    described = {"ParseMultiRobotPose": ("x",), "LaunchConfigAsBool": ("x",)}
    arguments = described.get(name, ("x", {}))
    assert getattr(nav2_common, name)(*arguments).describe().startswith(f"{name}(")


def test_launch_files_of_nav2_import_them(run: Callable[..., Any], tmp_path: Path) -> None:
    file = tmp_path / "a.launch.py"
    file.write_text(
        "from launch import LaunchDescription\n"
        "from launch.actions import LogInfo\n"
        "from nav2_common.launch import RewrittenYaml, ReplaceString, HasNodeParams\n"
        "def generate_launch_description():\n"
        "    gone = RewrittenYaml(source_file='/nowhere.yaml', param_rewrites={}, root_key='')\n"
        "    return LaunchDescription([LogInfo(msg=gone)])\n"
    )
    ran = run(actions.IncludeLaunchDescription(str(file)))
    (found,) = ran.context.diagnostics
    assert "No such file or directory: '/nowhere.yaml'" in found.message
    assert found.span is not None
    assert (found.span.file, found.span.line) == (str(file), 5)


_GIVEN: dict[str, dict[str, Any]] = {
    "GzServer": {"world_sdf_file": "empty.sdf", "use_composition": "False"},
    "GzSpawnModel": {"entity_name": "crate", "xml_string": "<sdf/>", "yaw": "1.5"},
    "RosGzBridge": {"bridge_name": "b", "config_file": ["/tmp", "/b.yaml"], "condition": None},
}
_PASSED = {
    "GzServer": {"world_sdf_file": "empty.sdf", "use_composition": "False"},
    "GzSpawnModel": {"entity_name": "crate", "model_string": "<sdf/>", "Y": "1.5"},
    "RosGzBridge": {"bridge_name": "b", "config_file": "/tmp/b.yaml"},
}
_NODES = {"GzServer": "gzserver", "GzSpawnModel": "create", "RosGzBridge": "bridge_node"}


def _passed(include: Any, context: LaunchContext) -> dict[str, str]:
    return {
        name: perform_substitutions(context, value) if isinstance(value, list) else value
        for name, value in ((one, _texts(two)) for one, two in include.launch_arguments)
    }


def _texts(value: Any) -> Any:
    return "".join(value) if isinstance(value, list) and isinstance(value[0], str) else value


@pytest.mark.parametrize("name", ros_gz.__all__)
def test_action_of_ros_gz(name: str, context: LaunchContext) -> None:
    (include,) = getattr(ros_gz, name)(**_GIVEN[name]).execute(context)
    assert _passed(include, context) == _PASSED[name]
    description = include.launch_description_source.get_launch_description(context)
    nodes = [one for one in description.entities if hasattr(one, "node_executable")]
    assert [one.node_executable for one in nodes] == [_NODES[name]]
    assert include.span.file == __file__
    with pytest.raises(TypeError, match="unexpected keyword argument 'worldsdffile'"):
        getattr(ros_gz, name)(**{**_GIVEN[name], "worldsdffile": "x"})


def test_a_bridge_needs_its_file() -> None:
    with pytest.raises(TypeError, match="required keyword-only argument: 'config_file'"):
        ros_gz.RosGzBridge(bridge_name="b")


@pytest.mark.parametrize(
    ("suffix", "text"),
    [
        (
            "xml",
            '<launch><gz_server world_sdf_file="w.sdf"/><gz_spawn_model entity_name="$(var n)" '
            'x="1"/><ros_gz_bridge bridge_name="b" config_file="c"/></launch>',
        ),
        (
            "yaml",
            "launch:\n- gz_server: {world_sdf_file: w.sdf}\n- gz_spawn_model: "
            "{entity_name: $(var n), x: '1'}\n- ros_gz_bridge: {bridge_name: b, config_file: c}\n",
        ),
    ],
)
def test_markup_has_elements_of_ros_gz(
    suffix: str, text: str, tmp_path: Path, context: LaunchContext
) -> None:
    file = tmp_path / f"a.launch.{suffix}"
    file.write_text(text)
    root, parser = Parser.load(str(file))
    description: LaunchDescription = parser.parse_description(root)
    context.launch_configurations["n"] = "crate"
    includes: list[Any] = [one.execute(context)[0] for one in description.entities]  # type: ignore[attr-defined]
    assert [_passed(one, context) for one in includes] == [
        {"world_sdf_file": "w.sdf"},
        {"entity_name": "crate", "x": "1"},
        {"bridge_name": "b", "config_file": "c"},
    ]
