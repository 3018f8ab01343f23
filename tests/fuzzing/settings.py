"""Settings that people write: parameters of nodes, MoveIt, views, launches of ROS 2, builds."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache, partial
from pathlib import Path
from typing import Any, cast

import yaml
from tests.fuzzing.kind import Kind

from gazelle.cli.catkin import load_profile
from gazelle.description.loader import load_models
from gazelle.description.model import Model
from gazelle.description.moveit.config import typed_config
from gazelle.description.moveit.package_files import read_yaml
from gazelle.description.moveit.parameter_reader import Settings as MoveItSettings
from gazelle.description.srdf import Srdf, load_srdf
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.launch_ros2.launch_tree import follow
from gazelle.doctor.parameters.all_checks import check_parameter_file
from gazelle.documents.yaml import load_yaml
from gazelle.errors import GazelleError, LaunchError
from gazelle.graph.ros2_arguments import parse_ros_arguments
from gazelle.launch.ros2.error_diagnostics import diagnose
from gazelle.launch.ros2.frontend import Parser
from gazelle.launch.ros2.invalid_launch_file_error import InvalidLaunchFileError
from gazelle.launch.ros2.launch_ros.parameter_descriptions import ParameterFile
from gazelle.navigation.controllers import CONTROLLERS
from gazelle.navigation.localization import AmclOptions
from gazelle.navigation.planners import PLANNERS
from gazelle.nodes.amcl.node_parameters import AMCL, NAV2_AMCL
from gazelle.nodes.filters.laser_filters import chain_of
from gazelle.nodes.joy.parameters import read_options
from gazelle.nodes.nav2.behavior_trees.xml_parsing import read_trees
from gazelle.nodes.nav2.collision_monitor.parameters import (
    COLLISION_MONITOR,
    read_polygons,
    read_sources,
    report_others,
)
from gazelle.nodes.nav2.parameters import controller_table, planner_table
from gazelle.nodes.navigation.costmap_from_parameters import assemble
from gazelle.nodes.parameters import node_reader
from gazelle.nodes.robot_localization.ekf_node import config_of, matrix_of
from gazelle.nodes.robot_localization.parameters import ekf_table
from gazelle.nodes.ros_gz.bridge_config import read_file
from gazelle.nodes.slam.cartographer.configuration import read_configuration
from gazelle.nodes.slam.parameters import SLAM_NODES, options_of
from gazelle.nodes.teleop.twist_joy import read_driving
from gazelle.nodes.twist_mux.parameters import read_inputs
from gazelle.parameters.trees import nested
from gazelle.studio.plugins.rqt.ui_files import form_layout, form_widgets
from gazelle.studio.request_params import Params
from gazelle.studio.settings.rqt_perspectives import open_perspective
from gazelle.studio.settings.rviz_files import open_rviz
from gazelle.workspace import Workspace
from gazelle.workspace.building.cmake_lists import read_cmake_lists
from gazelle.workspace.building.setup_py import cfg_arguments, read_setup
from gazelle.workspace.entry_points import console_scripts

__all__ = ["SETTINGS"]

_ARM = Path(__file__).parents[2] / "examples" / "arm_ws" / "src"
_CONFIG = _ARM / "heron_moveit_config" / "config"
_BUILTIN = Path(__file__).parents[2] / "src" / "gazelle" / "workspace" / "builtin" / "packages"
# What launch and launch_ros raise for mistakes of the user, as the originals do.
_OF_LAUNCH = (
    InvalidLaunchFileError, OSError, RuntimeError, TypeError, ValueError, AttributeError,
    yaml.YAMLError,
)  # fmt: skip


def _tree(path: Path) -> dict[str, Any]:
    """Return a node's parameters, as the graph would hand them over."""
    try:
        found = load_yaml(path.read_bytes())
    except yaml.YAMLError as error:
        raise GazelleError(str(error)) from None
    if not isinstance(found, dict):
        raise GazelleError("no mapping")
    return nested(found)


def _group(tree: Mapping[str, Any], *keys: str) -> dict[str, Any]:
    found: Any = tree
    for key in keys:
        found = found.get(key) if isinstance(found, dict) else None
    return found if isinstance(found, dict) else {}


def _move_base(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    tree = _tree(path)
    for name in ("local_costmap", "global_costmap"):
        assemble(_group(tree, name), f"/move_base/{name}", diagnostics, above=tree)
    for plugin in ("dwa_local_planner/DWAPlannerROS", "base_local_planner/TrajectoryPlannerROS"):
        own = _group(tree, plugin.rpartition("/")[2])
        node_reader(controller_table(plugin), own, plugin, diagnostics).fill(
            CONTROLLERS[plugin].options
        )
    node_reader(AMCL, _group(tree, "amcl"), "/amcl", diagnostics).fill(AmclOptions)


def _nav2(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    tree = _tree(path)
    for name in ("local_costmap", "global_costmap"):
        own = _group(tree, name, name, "ros__parameters")
        assemble(own, f"/{name}/{name}", diagnostics, ros_version=2)
    for plugins, table, server in (
        (PLANNERS, planner_table, "planner_server"),
        (CONTROLLERS, controller_table, "controller_server"),
    ):
        for name, below in _group(tree, server, "ros__parameters").items():
            plugin = str(below.get("plugin")) if isinstance(below, dict) else ""
            if plugin in plugins:
                settings = node_reader(table(plugin), below, name, diagnostics)
                settings.fill(cast(Any, plugins)[plugin].options)
                settings.report_unknown("plugin")
    monitor = _group(tree, "collision_monitor", "ros__parameters")
    settings = node_reader(COLLISION_MONITOR, monitor, "/collision_monitor", diagnostics)
    read_polygons(settings)
    read_sources(settings)
    report_others(settings)
    own = _group(tree, "amcl", "ros__parameters")
    node_reader(NAV2_AMCL, own, "/amcl", diagnostics).fill(AmclOptions)


def _slam(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    tree = _tree(path)
    for name, slam_node in SLAM_NODES.items():
        settings = node_reader(slam_node.table, tree, name, diagnostics)
        options_of(slam_node, settings)
        settings.report_unknown()


def _small_nodes(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    """Read the parameters of twist_mux, joy, teleop, laser filters and robot_localization."""
    tree = _tree(path)
    for kind in ("topics", "locks"):
        read_inputs(kind, tree.get(kind), "/twist_mux", diagnostics)
    for ros_version in (1, 2):
        read_options(_group(tree, "joy"), "/joy", cast(Any, ros_version), diagnostics)
        own = _group(tree, "teleop")
        read_driving(own, "/teleop", diagnostics, is_ros2=ros_version == 2)
    ekf = _group(tree, "ekf")
    node_reader(ekf_table(ekf), ekf, "/ekf", diagnostics).report_unknown()
    for key, value in ekf.items():
        if key.endswith("_config"):
            config_of(key, value)
        if key.endswith("_covariance"):
            matrix_of(key, value)
    chain_of(tree, "/laser_filter", diagnostics)


@cache
def _heron() -> tuple[Model, Srdf]:
    workspace, diagnostics = Workspace.discover(extra=[_ARM]), Diagnostics()
    path = _ARM / "heron_description" / "urdf" / "heron.urdf.xacro"
    (robot,) = load_models(path, workspace=workspace, diagnostics=diagnostics)
    file = _CONFIG / "heron.srdf"
    srdf = load_srdf(file, robot=robot, workspace=workspace, diagnostics=diagnostics)
    assert srdf is not None
    return robot, srdf


def _moveit(above: str, path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    values, spans = read_yaml(path, diagnostics, {})
    tree = {above: values} if above else values
    inside = {((above, *key) if above else key): span for key, span in spans.items()}
    settings = MoveItSettings(tree, diagnostics, spans=inside)
    typed_config(settings, "robot_description", *_heron())


def _srdf(path: Path, diagnostics: Diagnostics, workspace: Workspace) -> None:
    load_srdf(path, robot=_heron()[0], workspace=workspace, diagnostics=diagnostics)


def _gz_bridge(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    _rows, wrong = read_file(path)
    if wrong:
        raise LaunchError("\n".join(wrong))


def _rviz(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    open_rviz(Params("rviz.open", {"path": str(path)}))


def _perspective(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    open_perspective(Params("perspective.open", {"path": str(path)}))


def _parameters(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    check_parameter_file(path, diagnostics=diagnostics)
    check_parameter_file(path, diagnostics=diagnostics, ros_version=1, joints=("wheel_left",))
    words = ["--ros-args", "--params-file", str(path), "-p", "a.b:=[1, 2]"]
    parse_ros_arguments(words).parameters("/robot/talker")


def _launch_ros2(path: Path, diagnostics: Diagnostics, workspace: Workspace) -> None:
    """Read a launch file as `ros2 launch` does, but do nothing of what it says; look it through."""
    follow(path, {"speed": "1.0"}, workspace=workspace, diagnostics=diagnostics)
    try:
        root, parser = Parser.load(path)
        parser.parse_description(root)
        ParameterFile(str(path))
    except RecursionError:
        raise
    except _OF_LAUNCH as error:
        for found in diagnose(error):
            diagnostics.add(found)


def _trees(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    read_trees(path, diagnostics)


def _lua(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    flags = {"configuration_directory": str(path.parent), "configuration_basename": path.name}
    read_configuration(flags)


def _cmake(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    read_cmake_lists(path.parent, "scout")


def _setup(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    read_setup(path.parent)
    console_scripts(path.parent)


def _setup_cfg(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    cfg_arguments(path.parent, lambda *_args, **_words: ())
    console_scripts(path.parent)


def _catkin(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    folder = path.parent / ".catkin_tools" / "profiles" / "default"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "config.yaml").write_bytes(path.read_bytes())
    profile = load_profile(path.parent)
    assert profile.root.name == path.parent.name


def _form(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    form_widgets(path)
    form_layout(path, 1)


_MOVE_BASE = b"""\
controller_frequency: 10.0
footprint: [[0.2, 0.2], [-0.2, 0.2], [-0.2, -0.2], [0.2, -0.2]]
obstacle_range: 2.5
local_costmap:
  global_frame: odom
  rolling_window: true
  width: 4.0
  resolution: 0.05
  plugins:
    - {name: obstacles, type: "costmap_2d::ObstacleLayer"}
    - {name: inflation, type: "costmap_2d::InflationLayer"}
  obstacles:
    observation_sources: scan
    scan: {sensor_frame: lidar, data_type: LaserScan, topic: scan, marking: true, clearing: true}
  inflation: {inflation_radius: 0.5, cost_scaling_factor: 3.0}
global_costmap:
  static_map: true
  map_type: costmap
  robot_radius: 0.3
  observation_sources: scan bump
  scan: {data_type: LaserScan, topic: scan}
DWAPlannerROS: {max_vel_x: 0.5, acc_lim_x: 2.5, sim_time: 1.7, vx_samples: 6}
TrajectoryPlannerROS/max_vel_x: 0.5
amcl: {min_particles: 100, max_particles: 500, odom_model_type: diff-corrected}
"""
_NAV2 = b"""\
amcl:
  ros__parameters: {alpha1: 0.2, laser_model_type: "likelihood_field", max_beams: 60}
controller_server:
  ros__parameters:
    controller_frequency: 20.0
    FollowPath:
      plugin: "dwb_core::DWBLocalPlanner"
      max_vel_x: 0.26
      critics: ["RotateToGoal", "Oscillation", "BaseObstacle", "PathAlign"]
      BaseObstacle.scale: 0.02
      PathAlign.scale: 32.0
planner_server:
  ros__parameters:
    planner_plugins: ["GridBased"]
    GridBased: {plugin: "nav2_navfn_planner/NavfnPlanner", tolerance: 0.5, use_astar: false}
local_costmap:
  local_costmap:
    ros__parameters:
      rolling_window: true
      width: 3
      footprint: "[[0.2, 0.2], [-0.2, 0.2], [-0.2, -0.2]]"
      plugins: ["voxel_layer", "inflation_layer"]
      inflation_layer: {plugin: "nav2_costmap_2d::InflationLayer", inflation_radius: 0.55}
      voxel_layer:
        plugin: "nav2_costmap_2d::VoxelLayer"
        z_voxels: 16
        observation_sources: scan
        scan: {topic: /scan, max_obstacle_height: 2.0, data_type: "LaserScan"}
global_costmap:
  global_costmap:
    ros__parameters: {robot_radius: 0.22, plugins: ["static_layer", "obstacle_layer"]}
collision_monitor:
  ros__parameters:
    polygons: ["Stop", "Slow"]
    Stop: {type: "circle", radius: 0.3, action_type: "stop", max_points: 3}
    Slow:
      type: "polygon"
      points: "[[0.5, 0.5], [0.5, -0.5], [-0.5, -0.5], [-0.5, 0.5]]"
      action_type: "slowdown"
      slowdown_ratio: 0.3
    observation_sources: ["scan"]
    scan: {type: "scan", topic: "scan"}
"""
_SLAM = b"""\
odom_frame: odom
map_frame: map
base_frame: base_footprint
scan_topic: /scan
mode: mapping
map_update_interval: 5.0
resolution: 0.05
max_laser_range: 20.0
minimum_travel_distance: 0.5
maxUrange: 8.0
particles: 30
delta: 0.05
linearUpdate: 1.0
do_loop_closing: true
map_start_pose: [0.0, 0.0, 0.0]
map_resolution: 0.025
hector.map_size: 1024
"""
_SMALL_NODES = b"""\
topics:
  - {name: joystick, topic: joy_vel, timeout: 0.5, priority: 100}
  - {name: navigation, topic: nav_vel, timeout: 0.5, priority: 10}
locks:
  pause: {topic: pause, timeout: 0.0, priority: 255}
joy: {dev: /dev/input/js0, deadzone: 0.05, autorepeat_rate: 20, device_id: 0}
teleop:
  axis_linear: {x: 1}
  scale_linear: {x: 0.7, y: .5}
  axis_angular: {yaw: 0}
  enable_button: 4
ekf:
  frequency: 30
  two_d_mode: true
  odom0: odom
  odom0_config: [false, false, false, false, false, false, true, true, false,
                 false, false, true, false, false, false]
  imu0: imu
  imu0_config: [false, false, false, true, true, true, false, false, false,
                true, true, true, true, true, true]
  process_noise_covariance: [0.05, 0.05, 0.06, 0.03, 0.03, 0.06, 0.025, 0.025, 0.04,
                             0.01, 0.01, 0.02, 0.01, 0.01, 0.015]
scan_filter_chain:
  - {name: range, type: laser_filters/LaserScanRangeFilter, params: {lower_threshold: 0.3}}
  - name: angle
    type: laser_filters/LaserScanAngularBoundsFilter
    params: {lower_angle: -1.0, upper_angle: 1.0}
"""
_OMPL = b"""\
planning_plugins: [ompl_interface/OMPLPlanner]
request_adapters: [default_planning_request_adapters/ResolveConstraintFrames]
start_state_max_bounds_error: 0.1
planner_configs:
  RRTConnectkConfigDefault: {type: "geometric::RRTConnect", range: 0.0}
  RRTstar: {type: "geometric::RRTstar", goal_bias: 0.05}
arm:
  default_planner_config: RRTConnectkConfigDefault
  planner_configs: [RRTConnectkConfigDefault, RRTstar]
  projection_evaluator: joints(shoulder_pan, elbow)
  longest_valid_segment_fraction: 0.005
"""
_GZ_BRIDGE = b"""\
- ros_topic_name: "scan"
  gz_topic_name: "/lidar"
  ros_type_name: "sensor_msgs/msg/LaserScan"
  gz_type_name: "gz.msgs.LaserScan"
  direction: GZ_TO_ROS
  subscriber_queue: 5
  lazy: true
- topic_name: "/clock"
  ros_type_name: "rosgraph_msgs/msg/Clock"
  gz_type_name: "gz.msgs.Clock"
- service_name: "/world/empty/control"
  ros_type_name: "ros_gz_interfaces/srv/ControlWorld"
  gz_req_type_name: "gz.msgs.WorldControl"
  gz_rep_type_name: "gz.msgs.Boolean"
"""
_RVIZ_1 = b"""\
Panels:
  - Class: rviz/Displays
    Name: Displays
    Property Tree Widget: {Expanded: [/Global Options1], Splitter Ratio: 0.5}
Visualization Manager:
  Class: ""
  Displays:
    - {Alpha: 0.5, Class: rviz/Grid, Color: 160; 160; 164, Enabled: true, Name: Grid}
    - Class: rviz/Group
      Name: Sensors
      Displays:
        - {Class: rviz/LaserScan, Enabled: true, Name: Scan, Topic: scan, Size (m): 0.05}
        - {Class: rviz/Image, Image Topic: /camera/image_raw, Name: Picture, Value: false}
    - {Class: rviz/RobotModel, Robot Description: robot_description, Name: Robot}
  Global Options: {Background Color: 48; 48; 48, Fixed Frame: odom, Frame Rate: 30}
  Tools:
    - {Class: rviz/SetGoal, Topic: /move_base_simple/goal}
  Views:
    Current:
      Class: rviz/Orbit
      Distance: 5.3
      Focal Point: {X: 0, Y: 1e-3, Z: 0}
      Pitch: 0.5
      Yaw: .785
Window Geometry: {Height: 800, QMainWindow State: 000000ff00000000}
"""
_PERSPECTIVE = rb"""{
  "keys": {},
  "groups": {
    "pluginmanager": {
      "keys": {"running-plugins": {"type": "repr",
        "repr": "{u'rqt_plot/Plot': [1, 2], u'rqt_image_view/ImageView': [1]}"}},
      "groups": {
        "plugin__rqt_plot__Plot__1": {"keys": {}, "groups": {"plugin": {
          "keys": {"topics": {"type": "repr", "repr": "[u'/odom/x', u'/odom/y']"}},
          "groups": {}}}},
        "plugin__rqt_image_view__ImageView__1": {"keys": {}, "groups": {"plugin": {
          "keys": {"topic": {"type": "repr", "repr": "u'/camera/image_raw'"}}, "groups": {}}}}
      }
    },
    "mainwindow": {"keys": {"geometry": {"type": "repr(QByteArray.hex)",
      "repr(QByteArray.hex)": "QtCore.QByteArray('01d9d0cb')"}}, "groups": {}}
  }
}
"""
_PARAMETERS = b"""\
/**:
  ros__parameters:
    use_sim_time: true
/robot/talker:
  ros__parameters:
    rate: 10.0
    names: ["a", 'b', c]
    flags: [true, false]
    nested: {deep: {er: 1e3}, octal: 0o17}
    text: "yes"
"*":
  talker: {ros__parameters: {joints: [wheel_left, wheel_right], n: -.5}}
"""
_LAUNCH_XML = b"""\
<launch>
  <arg name="speed" default="1.0" description="of the robot"/>
  <let name="twice" value="$(var speed)"/>
  <set_env name="A" value="$(env HOME)"/>
  <group scoped="true" forwarding="false">
    <push_ros_namespace namespace="robot"/>
    <node pkg="demo_nodes_py" exec="talker" name="talker" output="screen"
          if="$(equals $(var speed) 1.0)" respawn="true" respawn_delay="2.0">
      <param name="rate" value="10.0"/>
      <param name="list" value="1, 2, 3" value-sep=", "/>
      <param name="group"><param name="inner" value="$(var twice)" type="float"/></param>
      <param from="$(dirname)/a.yaml" allow_substs="true"/>
      <remap from="chatter" to="/chatter"/>
      <env name="B" value="c"/>
    </node>
  </group>
  <include file="$(find-pkg-share scout_robot)/launch/none.launch.xml">
    <arg name="x" value="1"/>
  </include>
  <executable cmd="echo hello" cwd="/tmp" name="e" shell="false"/>
  <log message="hello"/>
  <timer period="1.0"><shutdown reason="done"/></timer>
</launch>
"""
_LAUNCH_YAML = b"""\
launch:
- arg: {name: "speed", default: "1.0"}
- let: {name: "twice", value: "$(var speed)"}
- group:
  - push_ros_namespace: {namespace: "robot"}
  - node:
      pkg: "demo_nodes_py"
      exec: "talker"
      name: "talker"
      if: "$(eval '1 == 1')"
      param:
      - {name: "rate", value: 10.0}
      - {name: "list", value: [1, 2, 3]}
      - from: "$(dirname)/a.yaml"
      remap:
      - {from: "chatter", to: "/chatter"}
      env:
      - {name: "B", value: "c"}
- include:
    file: "$(find-pkg-share scout_robot)/launch/none.launch.yaml"
    arg:
    - {name: "x", value: "1"}
- executable: {cmd: "echo hello", output: "screen"}
"""
_TREE = b"""\
<root BTCPP_format="4" main_tree_to_execute="MainTree">
  <BehaviorTree ID="MainTree">
    <RecoveryNode number_of_retries="6" name="NavigateRecovery">
      <PipelineSequence name="NavigateWithReplanning">
        <RateController hz="1.0">
          <ReactiveFallback>
            <ComputePathToPose goal="{goal}" path="{path}" planner_id="GridBased"/>
            <SubTree ID="Clear" what="{what}" _autoremap="true"/>
          </ReactiveFallback>
        </RateController>
        <FollowPath path="{path}" controller_id="FollowPath" _skipIf="@done == true"/>
      </PipelineSequence>
      <Sequence>
        <Script code="tries := tries + 1; text = 'a'; ok := (tries &gt; 2) ? true : false"/>
        <RoundRobin><Spin spin_dist="1.57"/><Wait wait_duration="5.0"/></RoundRobin>
        <Inverter><GoalUpdated/></Inverter>
      </Sequence>
    </RecoveryNode>
  </BehaviorTree>
  <BehaviorTree ID="Clear">
    <ClearEntireCostmap name="c" service_name="local_costmap/clear_entirely_local_costmap"/>
  </BehaviorTree>
</root>
"""
_LUA = b"""\
include "map_builder.lua"
include "trajectory_builder.lua"

-- what the node does
options = {
  map_builder = MAP_BUILDER,
  trajectory_builder = TRAJECTORY_BUILDER,
  map_frame = "map",
  tracking_frame = "base_link",
  num_laser_scans = 1,
  lookup_transform_timeout_sec = 0.2,
  submap_publish_period_sec = 3e-1,
  ["publish_to_tf"] = true,
  list = { 1, 2; 3 },
}
MAP_BUILDER.use_trajectory_builder_2d = true
TRAJECTORY_BUILDER_2D.submaps = { num_range_data = 35 * 2 ^ 1, grid_options_2d = {} }
local function half(x) return x / 2 end
if math.pi > 3 and not false then TRAJECTORY_BUILDER_2D.min_range = half(math.sqrt(4)) end
POSE_GRAPH.optimize_every_n_nodes = #options.list
options.name = "a" .. tostring(1) .. [[b]]
return options
"""
_CMAKE = b"""\
cmake_minimum_required(VERSION 3.5)
project(scout VERSION 1.0.0)
option(WITH_TESTS "tests" OFF)
set(FILES a.cpp ${PROJECT_NAME}.cpp)
find_package(catkin REQUIRED COMPONENTS roscpp std_msgs)
if(WITH_TESTS AND NOT ("${FILES}" STREQUAL "") OR TARGET x)
  add_executable(tests test.cpp)
elseif(CMAKE_VERSION VERSION_LESS 3.10)
  message(STATUS "old")
else()
  set(OTHER [[raw]] CACHE STRING "x")
endif()
foreach(name IN LISTS FILES)
  list(APPEND ALL "src/${name}")
endforeach()
add_library(${PROJECT_NAME} SHARED ${ALL})
add_executable(node src/node.cpp)
set_target_properties(node PROPERTIES OUTPUT_NAME scout_node PREFIX "")
function(install_all kind)
  install(${kind} ${ARGN} DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
endfunction()
install_all(DIRECTORY launch worlds)
configure_file(robot.xacro.in robot.xacro @ONLY)
install(TARGETS node RUNTIME DESTINATION lib/${PROJECT_NAME}) # a comment
file(GLOB MESHES "meshes/*.stl")
"""
_SETUP = b"""\
from glob import glob
import os
from setuptools import find_packages, setup

package_name = 'scout'
files = [os.path.join('share', package_name)]

setup(
    name=package_name,
    version='0.0.1',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        (files[0], ['package.xml']),
        (os.path.join('share', package_name, 'launch'), glob('launch/*.launch.py')),
        *[(f'share/{package_name}/{x}', glob(x + '/*')) for x in ('a', 'b')],
    ],
    package_dir={'': 'src'},
    entry_points={'console_scripts': ['talker = scout.talker:main', 'x = %s.x:main' % 'scout']},
)
"""
_SETUP_CFG = b"""\
[metadata]
name = scout
version = 0.0.1
[options]
packages = find:
package_dir =
  = src
scripts = bin/a
[options.packages.find]
where = src
[options.entry_points]
console_scripts =
  talker = scout.talker:main
[options.data_files]
share/scout = launch/*
[develop]
script_dir=$base/lib/scout
"""
_CATKIN = b"""\
authors: []
blacklist: [a, b]
build_space: build
cmake_args: [-DCMAKE_BUILD_TYPE=Release]
devel_layout: linked
extend_path: null
install: false
source_space: src
"""
_FORM = b"""\
<?xml version="1.0" encoding="UTF-8"?>
<ui version="4.0">
 <class>Form</class>
 <widget class="QWidget" name="Form">
  <property name="windowTitle"><string>Speed</string></property>
  <layout class="QVBoxLayout" name="layout">
   <item><widget class="QPushButton" name="go_button">
     <property name="text"><string>&amp;Go</string></property></widget></item>
   <item><layout class="QHBoxLayout" name="row">
     <item><widget class="QSlider" name="speed">
       <property name="minimum"><number>-10</number></property>
       <property name="maximum"><number>10</number></property></widget></item>
     <item><widget class="QComboBox" name="mode"><item>
       <property name="text"><string>fast</string></property></item></widget></item>
     <item><widget class="QDoubleSpinBox" name="limit">
       <property name="singleStep"><double>0.1</double></property></widget></item>
   </layout></item>
  </layout>
 </widget>
</ui>
"""


def _own(name: str) -> bytes:
    return (_CONFIG / name).read_bytes()


SETTINGS: dict[str, Kind] = {
    "behavior_tree": Kind(lambda: _TREE, "a.xml", _trees),
    "catkin_profile": Kind(lambda: _CATKIN, "config.yaml", _catkin),
    "cmake_lists": Kind(lambda: _CMAKE, "CMakeLists.txt", _cmake),
    "gz_bridge": Kind(lambda: _GZ_BRIDGE, "a.yaml", _gz_bridge),
    "launch_xml": Kind(lambda: _LAUNCH_XML, "a.launch.xml", _launch_ros2),
    "launch_yaml": Kind(lambda: _LAUNCH_YAML, "a.launch.yaml", _launch_ros2),
    "lua": Kind(lambda: _LUA, "a.lua", _lua),
    "move_base": Kind(lambda: _MOVE_BASE, "a.yaml", _move_base),
    "moveit_controllers": Kind(
        partial(_own, "moveit_controllers.yaml"), "a.yaml", partial(_moveit, "")
    ),
    "moveit_kinematics": Kind(
        partial(_own, "kinematics.yaml"),
        "a.yaml",
        partial(_moveit, "robot_description_kinematics"),
    ),
    "moveit_limits": Kind(
        partial(_own, "joint_limits.yaml"), "a.yaml", partial(_moveit, "robot_description_planning")
    ),
    "moveit_ompl": Kind(lambda: _OMPL, "a.yaml", partial(_moveit, "ompl")),
    "moveit_pilz": Kind(
        partial(_own, "pilz_cartesian_limits.yaml"),
        "a.yaml",
        partial(_moveit, "robot_description_planning"),
    ),
    "nav2": Kind(lambda: _NAV2, "a.yaml", _nav2),
    "parameters": Kind(lambda: _PARAMETERS, "a.yaml", _parameters),
    "perspective": Kind(lambda: _PERSPECTIVE, "a.perspective", _perspective),
    "qt_form": Kind(lambda: _FORM, "a.ui", _form),
    "rviz": Kind(lambda: _RVIZ_1, "a.rviz", _rviz),
    "rviz_ros2": Kind(
        (_BUILTIN / "nav2_bringup" / "rviz" / "nav2_default_view.rviz").read_bytes, "a.rviz", _rviz
    ),
    "setup": Kind(lambda: _SETUP, "setup.py", _setup),
    "setup_cfg": Kind(lambda: _SETUP_CFG, "setup.cfg", _setup_cfg),
    "slam": Kind(lambda: _SLAM, "a.yaml", _slam),
    "small_nodes": Kind(lambda: _SMALL_NODES, "a.yaml", _small_nodes),
    "srdf": Kind(partial(_own, "heron.srdf"), "heron.srdf", _srdf),
}
