"""nav2_bringup's launch files and parameters, which launch files of robots include."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from gazelle.diagnostics import Diagnostics
from gazelle.launch.ros2 import LaunchContext
from gazelle.launch.ros2.actions import ExecuteProcess, IncludeLaunchDescription, LogInfo
from gazelle.launch.ros2.launch_description_sources import PythonLaunchDescriptionSource
from gazelle.launch.ros2.launch_ros.actions import LoadComposableNodes, Node
from gazelle.launch.ros2.launch_ros.node_executable import node_command
from gazelle.nodes.component_container import builtin_of_component
from gazelle.nodes.nav2.behavior_trees.xml_parsing import read_trees
from gazelle.workspace.ament_index import get_package_share_directory

_SHARE = Path(get_package_share_directory("nav2_bringup"))
_NAVIGATION = [
    "controller_server", "smoother_server", "planner_server", "behavior_server", "bt_navigator",
    "waypoint_follower", "velocity_smoother",
]  # fmt: skip
_COMMON = {
    "namespace": "", "use_sim_time": "false", "autostart": "true", "use_composition": "False",
    "container_name": "nav2_container", "use_respawn": "False", "log_level": "info",
}  # fmt: skip
# As Humble, Iron and Jazzy have them; `map` must be given in Humble.
_ARGUMENTS: dict[str, dict[str, str]] = {
    "navigation": _COMMON,
    "localization": {**_COMMON, "map": ""},
    "slam": {
        "namespace": "", "use_sim_time": "True", "autostart": "True", "use_respawn": "False",
        "log_level": "info",
    },
    "bringup": {
        "namespace": "", "use_namespace": "false", "slam": "False", "map": "",
        "use_localization": "True", "use_sim_time": "false", "autostart": "true",
        "use_composition": "True", "use_respawn": "False", "log_level": "info",
    },
    "rviz": {"namespace": "navigation", "use_namespace": "false", "use_sim_time": "false"},
}  # fmt: skip


def _source(name: str) -> PythonLaunchDescriptionSource:
    return PythonLaunchDescriptionSource(str(_SHARE / "launch" / f"{name}_launch.py"))


def _ends(entity: Any, context: LaunchContext) -> list[Any]:
    """Return what an entity comes to; processes are not started."""
    if isinstance(entity, ExecuteProcess):
        entity._perform_substitutions(context)  # type: ignore[attr-defined]
        return [entity]
    if isinstance(entity, LoadComposableNodes):
        return [entity]
    said = [entity] if isinstance(entity, LogInfo) else []
    return said + [end for part in entity.visit(context) or [] for end in _ends(part, context)]


def _started(name: str, context: LaunchContext, **arguments: str) -> list[Any]:
    return _ends(
        IncludeLaunchDescription(_source(name), launch_arguments=arguments.items()), context
    )


def _nodes(found: list[Any]) -> dict[str, Node]:
    return {one.node_name.rpartition("/")[2]: one for one in found if isinstance(one, Node)}


def _given(node: Node, context: LaunchContext) -> dict[str, Any]:
    """Return the parameters of a node, the last ones first."""
    files = _files(node, context)
    found: dict[str, Any] = {}
    for file in files:
        for section, values in yaml.safe_load(Path(file).read_text()).items():
            if section in ("/**", node.node_name.rpartition("/")[2]):
                found.update(values["ros__parameters"])
    return found


def _files(node: Node, context: LaunchContext) -> list[str]:
    words = node._Node__ros_arguments  # type: ignore[attr-defined]
    return [words[at + 1] for at, word in enumerate(words) if word == "--params-file"]


@pytest.mark.parametrize("name", sorted(_ARGUMENTS))
def test_arguments_and_their_defaults_are_those_of_nav2(name: str, context: LaunchContext) -> None:
    description = _source(name).get_launch_description(context)
    found = {}
    for one in description.get_launch_arguments():
        one.execute(context)
        found[one.name] = context.launch_configurations[one.name]
    file = found.pop("rviz_config" if name == "rviz" else "params_file")
    assert Path(file).is_file()
    assert found == _ARGUMENTS[name]


def test_every_node_of_navigation_is_there(context: LaunchContext) -> None:
    found = _nodes(_started("navigation", context, use_sim_time="True"))
    assert list(found) == [*_NAVIGATION, "collision_monitor", "lifecycle_manager_navigation"]
    for node in found.values():
        assert node_command(context, node.node_package, node.node_executable) is not None
        assert _given(node, context)["use_sim_time"] is True
    given = _given(found["lifecycle_manager_navigation"], context)
    assert given["node_names"] == [*_NAVIGATION, "collision_monitor"]
    assert given["autostart"] is True


def _chain(found: dict[str, Node]) -> dict[str, list[tuple[str, str]]]:
    return {
        name: [rule for rule in node.expanded_remapping_rules or [] if "cmd_vel" in rule[0]]
        for name, node in found.items()
    }


def test_with_collision_monitor_it_is_the_last_as_in_jazzy(context: LaunchContext) -> None:
    chain = _chain(_nodes(_started("navigation", context)))
    nav = [("cmd_vel", "cmd_vel_nav")]
    for name in ("controller_server", "behavior_server", "velocity_smoother"):
        assert chain[name] == nav
    given = yaml.safe_load((_SHARE / "params" / "nav2_params.yaml").read_text())
    values = given["collision_monitor"]["ros__parameters"]
    assert (values["cmd_vel_in_topic"], values["cmd_vel_out_topic"]) == (
        "cmd_vel_smoothed", "cmd_vel",
    )  # fmt: skip


def test_without_it_the_smoother_is_the_last_as_in_humble(
    context: LaunchContext, tmp_path: Path
) -> None:
    file = tmp_path / "nav2_params.yaml"
    file.write_text("controller_server: {ros__parameters: {use_sim_time: false}}")
    found = _nodes(_started("navigation", context, params_file=str(file), use_sim_time="True"))
    assert list(found) == [*_NAVIGATION, "lifecycle_manager_navigation"]
    chain = _chain(found)
    assert chain["controller_server"] == [("cmd_vel", "cmd_vel_nav")]
    assert chain["behavior_server"] == []
    assert chain["velocity_smoother"] == [
        ("cmd_vel", "cmd_vel_nav"), ("cmd_vel_smoothed", "cmd_vel"),
    ]  # fmt: skip
    assert _given(found["controller_server"], context)["use_sim_time"] is True


def test_servers_of_newer_nav2s_are_told_and_left_out(
    context: LaunchContext, tmp_path: Path
) -> None:
    file = tmp_path / "nav2_params.yaml"
    file.write_text("docking_server: {ros__parameters: {}}\nroute_server: {ros__parameters: {}}")
    found = _started("navigation", context, params_file=str(file))
    said = ["".join(sub.perform(context) for sub in one.msg)
            for one in found if isinstance(one, LogInfo)]  # fmt: skip
    assert [text.partition(": ")[2].partition(" ")[0] for text in said] == [
        "docking_server", "route_server",
    ]  # fmt: skip
    assert "drive up to the dock by NavigateToPose" in said[0]
    assert not {"docking_server", "route_server"} & set(_nodes(found))


def test_the_map_of_the_command_line_goes_before_that_of_the_file(
    context: LaunchContext, tmp_path: Path
) -> None:
    file = tmp_path / "nav2_params.yaml"
    file.write_text("map_server: {ros__parameters: {yaml_filename: own.yaml}}")
    for given, expected in (("", "own.yaml"), ("/maps/house.yaml", "/maps/house.yaml")):
        found = _nodes(_started("localization", context, params_file=str(file), map=given))
        assert list(found) == ["map_server", "amcl", "lifecycle_manager_localization"]
        assert _given(found["map_server"], context)["yaml_filename"] == expected


@pytest.mark.parametrize("slam", ["True", "False"])
def test_bringup_starts_localisation_or_slam(slam: str, context: LaunchContext) -> None:
    words = {"slam": slam, "use_composition": "False", "map": "/maps/house.yaml"}
    found = _nodes(_started("bringup", context, **words))
    own = {"slam_toolbox", "lifecycle_manager_slam"} if slam == "True" else {"map_server", "amcl"}
    assert own < set(found)
    assert ("amcl" in found) == (slam == "False")
    assert set(_NAVIGATION) < set(found)


def test_composition_loads_builtin_nodes_into_a_container(context: LaunchContext) -> None:
    found = _started("bringup", context, map="/maps/house.yaml")
    (container,) = (one for one in found if isinstance(one, Node))
    assert container.node_name.rpartition("/")[2] == "nav2_container"
    loads = [one for one in found if isinstance(one, LoadComposableNodes)]
    names = [
        builtin_of_component(*("".join(sub.perform(context) for sub in words) for words in both))
        for load in loads
        for both in ((node.package, node.node_plugin)
                     for node in load._LoadComposableNodes__nodes)  # type: ignore[attr-defined]
    ]  # fmt: skip
    assert [one.executable for one in names if one is not None] == [
        "map_server", "amcl", "lifecycle_manager", *_NAVIGATION, "collision_monitor",
        "lifecycle_manager",
    ]  # fmt: skip
    assert None not in names


def test_a_namespace_takes_parameters_topics_and_tf_along(
    context: LaunchContext, tmp_path: Path
) -> None:
    file = tmp_path / "nav2_params.yaml"
    file.write_text("amcl: {ros__parameters: {scan_topic: <robot_namespace>/scan}}")
    found = _nodes(
        _started(
            "bringup", context, use_namespace="true", namespace="tb3_1", use_composition="False",
            params_file=str(file), map="/maps/house.yaml",
        )
    )  # fmt: skip
    assert found["amcl"].node_name == "/tb3_1/amcl"
    assert ("/tf", "tf") in (found["amcl"].expanded_remapping_rules or [])
    files = _files(found["amcl"], context)
    content = yaml.safe_load(Path(files[0]).read_text())
    assert content["tb3_1"]["amcl"]["ros__parameters"]["scan_topic"] == "/tb3_1/scan"


def test_wrong_words_are_refused(context: LaunchContext) -> None:
    with pytest.raises(ValueError, match="launch argument 'slam' is 'maybe', neither True nor"):
        _started("bringup", context, slam="maybe")


@pytest.mark.parametrize(
    "path",
    sorted(Path(get_package_share_directory("nav2_bt_navigator")).glob("behavior_trees/*.xml")),
    ids=lambda path: path.name,
)
def test_behaviour_trees_have_no_mistakes(path: Path) -> None:
    diagnostics = Diagnostics()
    assert read_trees(path, diagnostics) is not None
    assert not list(diagnostics)
