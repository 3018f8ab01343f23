"""MoveItConfigsBuilder gives what the original gives."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from gazelle.compat.moveit_configs import (
    MoveItConfigs,
    MoveItConfigsBuilder,
    ParameterBuilder,
    ParameterBuilderFileNotFoundError,
    load_file,
    load_yaml,
)
from gazelle.compat.moveit_configs.parameter_files import rendered
from gazelle.errors import LaunchError, UserFileError
from gazelle.launch.ros2.launch_context import LaunchContext
from gazelle.launch.ros2.launch_ros.utilities.node_parameters import (
    evaluate_parameters,
    normalize_parameters,
)
from gazelle.launch.ros2.substitutions import LaunchConfiguration, TextSubstitution
from gazelle.workspace import ament_index

_URDF = (
    '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <xacro:arg name="tip" default="tool"/>\n'
    '  <link name="$(arg tip)"/>\n</robot>\n'
)
_PACKAGE = (
    '<package format="3"><name>{}</name><version>0.0.0</version><description>x</description>'
    '<maintainer email="a@b.example">a</maintainer><license>x</license></package>'
)
_FILES = {
    "arm.urdf.xacro": _URDF,
    "arm.srdf": '<robot name="arm"><group name="g"><link name="tool"/></group></robot>',
    "kinematics.yaml": "g:\n  kinematics_solver: kdl\n",
    "joint_limits.yaml": "joint_limits:\n  j:\n    max_velocity: {{ radians(180) }}\n",
    "moveit_controllers.yaml": "moveit_controller_manager: m\n",
    "pilz_cartesian_limits.yaml": "cartesian_limits:\n  max_rot_vel: 1.0\n",
}


@pytest.fixture
def config(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The config folder of ``arm_moveit_config`` in a workspace that is the current one."""
    folder = tmp_path / "src" / "arm_moveit_config"
    (folder / "config").mkdir(parents=True)
    (folder / "package.xml").write_text(_PACKAGE.format("arm_moveit_config"), encoding="utf-8")
    for name, text in _FILES.items():
        (folder / "config" / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    ament_index.known_workspace.cache_clear()
    yield folder / "config"
    ament_index.known_workspace.cache_clear()


def _write(folder: Path, name: str, text: str) -> None:
    (folder / name).write_text(text, encoding="utf-8")


def test_everything_is_loaded_from_the_usual_files(config: Path) -> None:
    found = MoveItConfigsBuilder("arm").to_moveit_configs()
    assert found.package_path == config.parent
    assert list(found.robot_description) == ["robot_description"]
    assert found.robot_description["robot_description"].endswith(
        '<robot name="arm"><link name="tool"/></robot>'
    )
    assert found.robot_description["robot_description"].startswith('<?xml version="1.0" ?><!-- ===')
    assert '<group name="g">' in found.robot_description_semantic["robot_description_semantic"]
    assert found.robot_description_kinematics == {
        "robot_description_kinematics": {"g": {"kinematics_solver": "kdl"}}
    }
    limits = found.joint_limits["robot_description_planning"]["joint_limits"]
    assert limits["j"]["max_velocity"] == pytest.approx(3.14159265)
    assert found.trajectory_execution == {
        "moveit_manage_controllers": True,
        "moveit_controller_manager": "m",
    }
    assert found.planning_scene_monitor == {
        "publish_planning_scene": True,
        "publish_geometry_updates": True,
        "publish_state_updates": True,
        "publish_transforms_updates": True,
        "publish_robot_description": False,
        "publish_robot_description_semantic": False,
    }
    assert found.move_group_capabilities == {"capabilities": "", "disable_capabilities": ""}
    assert found.sensors_3d == {} and found.moveit_cpp == {}


def test_all_parameters_merge_limits_of_joints_and_tip(config: Path) -> None:
    found = MoveItConfigsBuilder("arm").to_dict()
    planning = found["robot_description_planning"]
    assert set(planning) == {"joint_limits", "cartesian_limits"}
    assert found["planning_pipelines"] == [
        "chomp", "ompl", "pilz_industrial_motion_planner", "stomp",
    ]  # fmt: skip
    assert found["default_planning_pipeline"] == "ompl"
    assert found["ompl"]["planning_plugins"] == ["ompl_interface/OMPLPlanner"]
    assert found["ompl"]["planner_configs"]["RRTConnect"] == {
        "type": "geometric::RRTConnect",
        "range": 0.0,
    }
    assert len(found["ompl"]["planner_configs"]) == 24


def test_own_files_and_names_are_taken(config: Path) -> None:
    _write(config, "other.srdf", '<robot name="other"/>')
    _write(config, "cpp.yaml", "plan_request_params: {planning_attempts: 2}\n")
    _write(config, "sensors_3d.yaml", "sensors: [kinect]\nkinect: {max_range: 5.0}\n")
    found = (
        MoveItConfigsBuilder("arm", robot_description="robot")
        .robot_description(mappings={"tip": "hand"})
        .robot_description_semantic(config / "other.srdf")
        .planning_pipelines(pipelines=["ompl"])
        .planning_scene_monitor(publish_robot_description=True)
        .moveit_cpp("config/cpp.yaml")
        .to_moveit_configs()
    )
    assert '<link name="hand"/>' in found.robot_description["robot"]
    assert '"other"' in found.robot_description_semantic["robot_semantic"]
    assert found.planning_pipelines["planning_pipelines"] == ["ompl"]
    assert found.planning_scene_monitor["publish_robot_description"] is True
    assert found.moveit_cpp == {"plan_request_params": {"planning_attempts": 2}}
    assert found.sensors_3d["kinect"] == {"max_range": 5.0}
    assert found.pilz_cartesian_limits == {}, "nothing asks for them without Pilz' planner"
    assert "robot_planning" in found.to_dict()


def test_a_packages_own_pipelines_come_first(config: Path) -> None:
    _write(config, "ompl_planning.yaml", "planning_plugin: mine\nplanner_configs: {}\n")
    _write(config, "zzz_planning.yaml", "planning_plugin: z\n")
    builder = MoveItConfigsBuilder("arm").planning_pipelines()
    found = builder.to_moveit_configs().planning_pipelines
    assert found["planning_pipelines"][:2] == ["ompl", "zzz"]
    assert found["ompl"] == {"planning_plugin": "mine", "planner_configs": {}}
    only = MoveItConfigsBuilder("arm").planning_pipelines(load_all=False).to_moveit_configs()
    assert only.planning_pipelines["planning_pipelines"] == ["ompl", "zzz"]
    with pytest.raises(
        RuntimeError, match="`chomp` doesn't name any of the input pipelines `ompl`"
    ):
        MoveItConfigsBuilder("arm").planning_pipelines("chomp", ["ompl"])


def test_the_setup_assistants_file_is_followed(config: Path) -> None:
    (config / "arm.urdf.xacro").rename(config / "robot.xacro")
    _write(
        config.parent,
        ".setup_assistant",
        "moveit_setup_assistant_config:\n  urdf:\n    package: arm_moveit_config\n"
        "    relative_path: config/robot.xacro\n    xacro_args: tip:=flange\n"
        "  srdf:\n    relative_path: config/arm.srdf\n",
    )
    found = MoveItConfigsBuilder("arm").to_moveit_configs()
    assert '<link name="flange"/>' in found.robot_description["robot_description"]


def test_controllers_are_guessed_or_asked_for(
    config: Path, caplog: pytest.LogCaptureFixture
) -> None:
    _write(config, "ros2_controllers.yaml", "a: 1\n")
    found = MoveItConfigsBuilder("arm").trajectory_execution().to_moveit_configs()
    assert found.trajectory_execution["moveit_controller_manager"] == "m"
    (config / "moveit_controllers.yaml").rename(config / "a_controllers.yaml")
    with pytest.raises(RuntimeError, match="Unable to guess which parameter file to load"):
        MoveItConfigsBuilder("arm").trajectory_execution()
    own = MoveItConfigsBuilder("arm").trajectory_execution(
        "config/a_controllers.yaml", moveit_manage_controllers=False
    )
    assert own.to_moveit_configs().trajectory_execution == {
        "moveit_manage_controllers": False,
        "moveit_controller_manager": "m",
    }
    for name in ("a_controllers.yaml", "ros2_controllers.yaml"):
        (config / name).unlink()
    with caplog.at_level(logging.WARNING):
        MoveItConfigsBuilder("arm").trajectory_execution()
    assert "no matches for" in caplog.text


def test_missing_files_are_errors_except_that_of_pilz(
    config: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (config / "pilz_cartesian_limits.yaml").unlink()
    with caplog.at_level(logging.WARNING):
        found = MoveItConfigsBuilder("arm").to_dict()
    assert "cartesian_limits" not in found["robot_description_planning"]
    assert "moveit_configs_utils stops the launch here" in caplog.text
    (config / "kinematics.yaml").rename(config / "kinematic.yaml")
    with pytest.raises(ParameterBuilderFileNotFoundError) as caught:
        MoveItConfigsBuilder("arm").to_dict()
    assert str(caught.value).startswith(f"File {config / 'kinematics.yaml'} doesn't exist")
    assert "did you mean 'kinematic.yaml'" in str(caught.value)


def test_old_limits_of_the_tip_are_told(config: Path, caplog: pytest.LogCaptureFixture) -> None:
    _write(config, "cartesian_limits.yaml", "cartesian_limits: {}\n")
    with caplog.at_level(logging.WARNING):
        MoveItConfigsBuilder("arm").pilz_cartesian_limits()
    assert "please rename to pilz_cartesian_limits.yaml" in caplog.text


def test_builders_do_not_share_parameters(config: Path) -> None:
    first = ParameterBuilder("arm_moveit_config").parameter("a", 1)
    first.yaml("config/kinematics.yaml").yaml("config/kinematics.yaml", "ns")
    first.file_parameter("text", "config/kinematics.yaml")
    first.xacro_parameter("urdf", "config/arm.urdf.xacro", {"tip": "x"})
    found = first.to_dict()
    assert (found["a"], found["g"]) == (1, found["ns"]["g"])
    assert found["text"] == _FILES["kinematics.yaml"] and '<link name="x"/>' in found["urdf"]
    assert ParameterBuilder("arm_moveit_config").to_dict() == {}
    alone = MoveItConfigsBuilder("arm").to_dict(include_moveit_configs=False)
    assert alone == {}


def test_broken_files_say_where(config: Path) -> None:
    _write(config, "kinematics.yaml", "g: [1,\n")
    with pytest.raises(UserFileError, match=r"kinematics.yaml:2:1: error: not YAML"):
        MoveItConfigsBuilder("arm").robot_description_kinematics()
    _write(config, "arm.urdf.xacro", _URDF.replace("$(arg tip)", "${tipp}"))
    with pytest.raises(UserFileError, match=r"arm.urdf.xacro:3:") as caught:
        MoveItConfigsBuilder("arm").robot_description()
    assert "tipp" in str(caught.value)


def test_an_empty_configuration_has_no_parameters() -> None:
    assert MoveItConfigs().to_dict() == {}


def test_expressions_in_double_braces(tmp_path: Path) -> None:
    values: dict[str, Any] = {"a": 2, "b": {"c": 3}}
    assert rendered("x: {{ a * (b.c - 1) / -b['c'] }}", values, "f") == f"x: {2 * 2 / -3}"
    assert rendered("x: {{ degrees(radians(90)) }}", {}, "f") == "x: 90.0"
    assert rendered("no braces $(arg x)", {}, "f") == "no braces $(arg x)"
    file = tmp_path / "f.yaml"
    file.write_text("a: {{ n }}\n", encoding="utf-8")
    assert load_file(file) == "a: {{ n }}\n" and load_yaml(file, {"n": 4}) == {"a": 4}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a\nx: {{ nobody }}", "f:2: '{{ nobody }}' cannot be worked out"),
        ("x: {{ __import__('os') }}", "is not understood"),
        ("{% if a %}{% endif %}", "statements of Jinja2: pip install jinja2"),
    ],
)
def test_expressions_that_need_more_are_told(
    text: str, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "jinja2", None)
    with pytest.raises(LaunchError) as caught:
        rendered(text, {}, "f")
    assert words in str(caught.value)


def test_luck_has_its_parameters(
    workspaces_dir: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.chdir(workspaces_dir / "ros2_ws")
    ament_index.known_workspace.cache_clear()
    builder = MoveItConfigsBuilder("luck_description", package_name="luck_robot")
    found = builder.to_moveit_configs()
    ament_index.known_workspace.cache_clear()
    manager = found.trajectory_execution["moveit_simple_controller_manager"]
    assert manager["controller_names"] == ["test_group_controller"]
    assert '<group name="test_group">' in found.to_dict()["robot_description_semantic"]
    assert found.joint_limits["robot_description_planning"]["joint_limits"]["joint_6"] == {
        "has_velocity_limits": True,
        "max_velocity": 1.0,
        "has_acceleration_limits": True,
        "max_acceleration": 1.0,
    }
    assert "Cannot infer SRDF" in caplog.text


def test_mappings_may_be_substitutions(config: Path) -> None:
    """As the demos of moveit_resources hand over their arguments."""
    builder = MoveItConfigsBuilder("arm")
    builder.robot_description(mappings={"tip": LaunchConfiguration("tip"), "n": "1"})
    builder.robot_description_semantic(mappings={"x": [TextSubstitution(text="a"), "b"]})
    context = LaunchContext()
    context.launch_configurations["tip"] = "gripper"
    configs = builder.to_moveit_configs()
    (urdf,) = configs.robot_description.values()
    (srdf,) = configs.robot_description_semantic.values()
    assert '<link name="gripper"/>' in urdf.evaluate(context)
    assert '<group name="g">' in srdf.evaluate(context)
    evaluated = evaluate_parameters(context, normalize_parameters([configs.to_dict()]))
    assert '<link name="gripper"/>' in str(evaluated[0]["robot_description"])


def test_mappings_of_a_xacro_parameter_may_be_substitutions(config: Path) -> None:
    builder = ParameterBuilder("arm_moveit_config")
    mappings = {"tip": LaunchConfiguration("tip")}
    builder.xacro_parameter("robot", "config/arm.urdf.xacro", mappings=mappings)
    context = LaunchContext()
    context.launch_configurations["tip"] = "gripper"
    assert '<link name="gripper"/>' in builder.to_dict()["robot"].evaluate(context)


def test_path_that_is_a_substitution_is_told_with_the_way_round(config: Path) -> None:
    file: Any = LaunchConfiguration("file")
    with pytest.raises(TypeError, match=r"robot_description: the file's path is a Launch.*Opaque"):
        MoveItConfigsBuilder("arm").robot_description(file)
    with pytest.raises(TypeError, match="yaml: the file's path is a LaunchConfiguration"):
        ParameterBuilder("arm_moveit_config").yaml(file)


def test_urdf_that_is_not_there_comes_by_topic(
    config: Path, caplog: pytest.LogCaptureFixture
) -> None:
    MoveItConfigsBuilder("arm").robot_description("config/arn.urdf.xacro")
    assert "did you mean 'arm.urdf.xacro'?" in caplog.text
    assert "will be loaded from /robot_description topic" in caplog.text


def test_what_xacro_says_reaches_standard_error_once(
    config: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    _write(config, "start.yaml", "j: 0.5\n")
    text = "${load_yaml('" + str(config / "start.yaml") + "')['j']}"
    _write(config, "arm.urdf.xacro", _URDF.replace("$(arg tip)", text))
    assert '<link name="0.5"/>' in MoveItConfigsBuilder("arm").to_moveit_configs().to_dict()[
        "robot_description"
    ]  # fmt: skip
    said = "Using load_yaml() directly is deprecated. Use xacro.load_yaml() instead."
    assert capsys.readouterr().err.count(said) == 1
