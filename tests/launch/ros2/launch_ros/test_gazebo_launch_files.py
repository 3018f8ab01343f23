"""Launch files that users include: gazebo_ros, ros_gz_sim, ros_gz_bridge and their old names."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from gazelle.launch.ros2 import LaunchContext
from gazelle.launch.ros2.actions import IncludeLaunchDescription
from gazelle.launch.ros2.launch_description_sources import PythonLaunchDescriptionSource
from gazelle.workspace.ament_index import get_package_share_directory

_BOX = '<sdf version="1.6"><model name="box"><link name="link"/></model></sdf>'
_INCLUDE = """
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    share = FindPackageShare("{package}")
    source = PythonLaunchDescriptionSource([PathJoinSubstitution([share, "launch", "{file}"])])
    included = IncludeLaunchDescription(source, launch_arguments={arguments!r}.items())
    return LaunchDescription([included, {node}])
"""


def _file(tmp_path: Path, package: str, file: str, node: str, **arguments: str) -> str:
    path = tmp_path / "world.launch.py"
    path.write_text(_INCLUDE.format(package=package, file=file, node=node, arguments=arguments))
    return str(path)


def _model_names(launched: Any) -> list[str]:
    kind = "gazebo_msgs/srv/GetWorldProperties"
    answer = launched.call("/gazebo/get_world_properties", kind)
    return list(answer.model_names)


def test_classic_world_takes_entities(gazelle: Callable[..., Any], tmp_path: Path) -> None:
    (tmp_path / "box.sdf").write_text(_BOX)
    words = ["-file", str(tmp_path / "box.sdf"), "-entity", "crate", "-z", "1"]
    node = f"Node(package='gazebo_ros', executable='spawn_entity.py', arguments={words!r})"
    file = _file(tmp_path, "gazebo_ros", "gazebo.launch.py", node, pause="true", seed="3")
    world = gazelle("ros2", "launch", file, "verbose:=true")
    world.wait_for_line(r"Spawn status: SpawnEntity: Successfully spawned entity \[crate\]")
    logs = "".join(path.read_text() for path in tmp_path.rglob("*.log"))
    assert "server plug-in 'libgazebo_ros_init.so' is part of Gazelle" in logs
    assert "'libgazebo_ros_factory.so'" in logs
    assert "libgazebo_ros_state.so" not in logs
    assert "part of Gazelle" not in world.text
    assert world.wait_for_line(r"^\[gzclient-\d\] \[INFO\] .*no window opens")
    listed = world.call("/get_model_list", "gazebo_msgs/srv/GetModelList")
    assert list(listed.model_names) == ["ground_plane", "crate"]
    kind = "gazebo_msgs/srv/GetWorldProperties"
    assert world.call("/gazebo/get_world_properties", kind).sim_time == 0.0
    assert world.stop() == 0


def test_launch_ends_with_a_server_that_is_required(gazelle: Callable[..., Any]) -> None:
    words = ("gui:=false", "server_required:=true", "iters:=5", "init:=false", "gdb:=true")
    world = gazelle("ros2", "launch", "gazebo_ros", "gazebo.launch.py", *words)
    assert world.wait() == 0
    assert "gdb is not started: gzserver is written in Python" in world.text
    assert "libgazebo_ros_init" not in world.text
    assert "[INFO] [gzserver-1]: process has finished cleanly" in world.text


def test_new_gazebo_takes_models_and_its_topics_are_bridged(
    gazelle: Callable[..., Any], tmp_path: Path
) -> None:
    """The names with ign, of packages and nodes; a launch file of that name includes gz_sim's."""
    package, file = "ros_gz_sim", "gz_sim.launch.py"
    node = f"""
        Node(package='ros_ign_gazebo', executable='create', arguments=['-string', '''{_BOX}''',
             '-name', 'crate', '-x', '2'], output='screen'),
        Node(package='ros_ign_bridge',
             executable='parameter_bridge', remappings=[('/clock', '/sim/clock')],
             arguments=['/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock'], output='screen')"""
    world = gazelle("ros2", "launch", _file(tmp_path, package, file, node, ign_args="-r"))
    world.wait_for_line(r"\[create-\d\] .*Entity creation successful\.")
    assert "crate" in _model_names(world)
    clock = world.messages({"/sim/clock": 1})["/sim/clock"][0]
    assert clock.clock.sec >= 0
    assert world.stop() == 0


def test_world_and_bridge_are_nodes_without_containers(
    gazelle: Callable[..., Any], tmp_path: Path
) -> None:
    text = f'<sdf version="1.6"><world name="w">{_BOX[19:-6]}</world></sdf>'
    (tmp_path / "w.sdf").write_text(text)
    (tmp_path / "b.yaml").write_text(
        "- {ros_topic_name: /ticks, gz_topic_name: /clock, direction: GZ_TO_ROS,"
        " ros_type_name: rosgraph_msgs/msg/Clock, gz_type_name: gz.msgs.Clock}"
    )
    node = f"""
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource([FindPackageShare('ros_gz_bridge'),
                                           '/launch/ros_gz_bridge.launch.py']),
            launch_arguments={{'bridge_name': 'ticker',
                              'config_file': '{tmp_path / "b.yaml"}'}}.items()),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource([FindPackageShare('ros_gz_sim'),
                                           '/launch/gz_spawn_model.launch.py']),
            launch_arguments={{'model_string': '''{_BOX}''', 'entity_name': '007',
                              'x': '1.5'}}.items())"""
    world_file = str(tmp_path / "w.sdf")
    file = _file(tmp_path, "ros_gz_sim", "gz_server.launch.py", node, world_sdf_file=world_file)
    world = gazelle("ros2", "launch", file)
    world.wait_for_line(r"Entity creation successful\.")
    assert set(_model_names(world)) == {"box", "007"}
    assert world.messages({"/ticks": 1})["/ticks"]
    assert "/ticker" in world.graph.node_names()
    assert world.stop() == 0


def test_world_and_bridge_of_one_file(gazelle: Callable[..., Any], tmp_path: Path) -> None:
    (tmp_path / "b.yaml").write_text(
        "- {ros_topic_name: /ticks, gz_topic_name: /clock, direction: GZ_TO_ROS,"
        " ros_type_name: rosgraph_msgs/msg/Clock, gz_type_name: gz.msgs.Clock}"
    )
    (tmp_path / "w.sdf").write_text(
        f'<sdf version="1.6"><world name="w">{_BOX[19:-6]}</world></sdf>'
    )
    words = ("bridge_name:=ticker", f"config_file:={tmp_path / 'b.yaml'}")
    file = f"world_sdf_file:={tmp_path / 'w.sdf'}"
    world = gazelle("ros2", "launch", "ros_gz_sim", "ros_gz_sim.launch.py", *words, file)
    assert world.messages({"/ticks": 1})["/ticks"]
    assert "/ticker" in world.graph.node_names()
    assert world.stop() == 0


def test_older_names_of_launch_files_include_the_new_ones(context: LaunchContext) -> None:
    share = get_package_share_directory("ros_ign_gazebo")
    source = PythonLaunchDescriptionSource(f"{share}/launch/ign_gazebo.launch.py")
    (include,) = source.get_launch_description(context).entities
    assert isinstance(include, IncludeLaunchDescription)
    include.execute(context)
    new = get_package_share_directory("ros_gz_sim")
    assert include.launch_description_source.location == f"{new}/launch/gz_sim.launch.py"
