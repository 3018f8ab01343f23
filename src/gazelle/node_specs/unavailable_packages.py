"""Packages of ROS that are not here, and programs of packages that are; what does their work.

What Gazelle has itself stands in the rows of nodes and in its folder of packages, not here.
"""

from __future__ import annotations

from enum import Enum
from functools import cache
from typing import NamedTuple

from gazelle.errors import NotFoundError

__all__ = [
    "FAMILIES",
    "PACKAGES",
    "PROGRAMS",
    "Sends",
    "UnavailablePackage",
    "UnavailableProgram",
    "missing_node",
    "missing_package",
    "replacement_of",
    "unavailable_packages",
    "what_it_sends",
]


_DRIVER = "the driver of a real {}, which a simulation does not need: {}"
_CAMERA = _DRIVER.format("camera", "a <sensor type='camera'> publishes its topics")
_LIDAR = _DRIVER.format("laser scanner", "a <sensor type='gpu_lidar'> or 'ray' publishes its scan")
_BRIDGE = "a bridge to programs outside of ROS; `gazelle bridge` is one"
_VIEW = "a window that is not here; `{rviz}` opens Studio, which shows the same topics"
_PANEL = "a panel of rqt that is not here; `{topic}`, `{param}` and Studio show the same"
_MANAGER_PANEL = "a panel of rqt that is not here; {controllers} show and do the same"
_JOYSTICK = "for a joystick; `joy` and `teleop_twist_joy` are here, with the kernel's joysticks"
_MARKER = "a marker in RViz that drives; Studio's teleop and `teleop_twist_keyboard` drive as well"
_INDUSTRIAL = "the link to a real arm's controller; `move_group` and ros_control's are here"
_DEPTH = "compiled filters of a depth camera's pictures; the simulated camera has clouds itself"
_SCANS = "compiled code that joins or makes scans; a <sensor> with a wider angle gives one"
_VELOCITIES = "compiled code that smooths or chooses velocities; `twist_mux` chooses by priority"
_MAPPING = "mapping in 3D is not here; slam_toolbox makes maps of laser scans"
_VISION = "compiled code that works on images; a node with cv_bridge in Python can do it"
_FIRMWARE = "the firmware's link of a real robot; a simulated one publishes these topics itself"
_CONTROL = "compiled code of ros2_control; `controller_manager` and its spawner are here"
_MOVEIT = "compiled code of MoveIt; `moveit_ros_move_group` and MotionPlanning in Studio are here"
_NAV2 = "compiled code of Nav2; its planner, controller, amcl and map_server are here"
_PICTURES = "the way of compressed pictures; cameras send `…/compressed` themselves where asked to"
_HEALTH = "the summary of /diagnostics, which is published; `{topic} echo /diagnostics` shows it"
_ODOMETRY = "compiled code that makes odometry of scans; the simulated base has odometry itself"
_IMU = "compiled filters of an IMU; the simulated IMU has an orientation, an EKF fuses it"
_LOCAL = "a compiled local planner; DWA, TrajectoryPlannerROS and Nav2's MPPI, DWB and RPP are here"
_POSES = "compiled code that sends a robot's tf as a pose; `tf2_echo` shows it, tf2_ros looks it up"
_KEYS = "for a keyboard or mouse; `teleop_twist_keyboard` and Studio's teleop drive as well"
_STAMPED = "for stamped velocities; the simulated bases take Twist and TwistStamped"
_BOOT = "for starting ROS with a real robot's computer; a simulation is started by hand"
_MODELS = "a robot and worlds for examples of Nav2: put its folder into the workspace's src"
_VIEWERS = "compiled code that works on images; `image_view` and `rosbag record` show and keep them"

_MORE = """
admittance_controller ament_cmake ament_cmake_auto ament_cmake_gtest ament_cmake_pytest
ament_cmake_python ament_cmake_ros ament_copyright ament_flake8 ament_index_cpp
ament_lint_auto ament_lint_common ament_pep257 ament_python ament_xmllint
camera_info_manager catkin class_loader cmake_modules control_toolbox diagnostic_updater
eigen ekf_localization fake_components filters gazebo_dev geometric_shapes
hector_gazebo_plugins interactive_markers joint_limits_interface kdl_parser laser_proc
launch_testing_ament_cmake message_generation message_runtime
moveit_fake_controller_manager moveit_planners moveit_resources
moveit_resources_prbt_moveit_config moveit_ros moveit_ros_benchmarks
moveit_ros_warehouse moveit_visual_tools nav2_rviz_plugins nav2_theta_star_planner
opencv_bridge pcl_conversions pcl_ros pluginlib rclcpp rclcpp_action rclcpp_lifecycle
realsense2_description resource_retriever rmw ros2bag ros2cli ros2launch ros2run
ros2topic ros_gz ros_ign ros_ign_interfaces rosbash rosboost_cfg
rosidl_default_generators rosidl_default_runtime roslint rospack rqt_common_plugins
rviz_common rviz_default_plugins rviz_imu_plugin sdformat_urdf spawn_entity stage_ros
tf2 tf2_eigen tf2_kdl trac_ik_kinematics_plugin tracetools transmission_interface
urdf_parser_plugin urdfdom urdfdom_headers velodyne_description velodyne_gazebo_plugins
velodyne_simulator vision_opencv visp visualization warehouse_ros warehouse_ros_mongo
warehouse_ros_sqlite yaml_cpp_vendor
"""

# Commands by the version of ROS whose user is told of them.
_COMMANDS = {
    1: {
        "topic": "rostopic",
        "param": "rosparam",
        "rviz": "rviz",
        "controllers": "`controller_manager list`, `start` and `stop`",
    },
    2: {
        "topic": "ros2 topic",
        "param": "ros2 param",
        "rviz": "rviz2",
        "controllers": "`ros2 control list_controllers`, `switch_controllers`, "
        "`list_hardware_components` and `set_hardware_component_state`",
    },
}


class Sends(Enum):
    """What nodes send that a tree of frames is made of."""

    NOTHING = "neither joint states nor transforms"
    TRANSFORMS = "transforms, which cannot be told"
    ANYTHING = "not known"


class UnavailablePackage(NamedTuple):
    """A package of ROS that is not here.

    Attributes:
        name: of the package, or of a family of packages its first letters.
        instead: what it is and what does its work, with commands of the user's ROS in braces;
            empty where nothing is to be said.
        sends: what its nodes send.
    """

    name: str
    instead: str = ""
    sends: Sends = Sends.ANYTHING


FAMILIES = (
    UnavailablePackage("rqt_", _PANEL, Sends.NOTHING),
    UnavailablePackage("yocs_", _VELOCITIES),
)


class UnavailableProgram(NamedTuple):
    """A program that its package has in ROS and not here; everything else of the package runs.

    Attributes:
        package, executable: its name.
        instead: what it is and what does its work.
        sends: what it sends.
    """

    package: str
    executable: str
    instead: str
    sends: Sends = Sends.ANYTHING


PROGRAMS = (
    UnavailableProgram(
        "joy",
        "game_controller_node",
        "SDL's layout of game controllers; `joy_node` sends the same topic in the kernel's "
        "order of axes and buttons",
        Sends.NOTHING,
    ),
    UnavailableProgram(
        "robot_localization",
        "ukf_localization_node",
        "the unscented filter; `ekf_localization_node` fuses the same inputs with the same "
        "parameters",
        Sends.TRANSFORMS,
    ),
    UnavailableProgram(
        "robot_localization",
        "ukf_node",
        "the unscented filter; `ekf_node` fuses the same inputs with the same parameters",
        Sends.TRANSFORMS,
    ),
    UnavailableProgram(
        "robot_localization",
        "navsat_transform_node",
        "for positions of satellites; robot_localization's pose0 takes poses",
        Sends.TRANSFORMS,
    ),
    UnavailableProgram(
        "robot_localization",
        "robot_localization_listener_node",
        "for poses at other times; tf2_ros looks them up",
        Sends.TRANSFORMS,
    ),
    UnavailableProgram(
        "pointcloud_to_laserscan",
        "laserscan_to_pointcloud_node",
        "for clouds of scans; laser_geometry's Python module makes them",
        Sends.NOTHING,
    ),
    UnavailableProgram(
        "laser_filters",
        "scan_to_cloud_filter_chain",
        "for clouds of filtered scans; `scan_to_scan_filter_chain` and laser_geometry's Python "
        "module do both steps",
        Sends.NOTHING,
    ),
    UnavailableProgram(
        "laser_filters",
        "generic_laser_filter_node",
        "an older name; `scan_to_scan_filter_chain` filters scans",
        Sends.NOTHING,
    ),
    UnavailableProgram(
        "slam_toolbox",
        "merge_maps_kinematic",
        "for putting maps together by hand; one mapping run over both places makes one map",
        Sends.TRANSFORMS,
    ),
    UnavailableProgram(
        "cartographer_ros",
        "cartographer_offline_node",
        "for bags without time; `cartographer_node` maps while `rosbag play` plays",
        Sends.TRANSFORMS,
    ),
    UnavailableProgram(
        "nav2_map_server",
        "costmap_filter_info_server",
        "for keep-out masks; costmap filters are not here, an obstacle in the map keeps robots out",
    ),
    UnavailableProgram(
        "tf2_ros", "buffer_server", "for look-ups by an action; nodes listen to /tf themselves"
    ),
    UnavailableProgram(
        "topic_tools", "delay", "for late copies of a topic; `relay` copies without a delay"
    ),
    UnavailableProgram(
        "ros_gz_bridge", "static_bridge", "for a single topic; `parameter_bridge` bridges any"
    ),
    *(
        UnavailableProgram("image_view", name, _VIEWERS, Sends.NOTHING)
        for name in ("extract_images", "image_saver", "stereo_view", "video_recorder")
    ),
)


def unavailable_packages() -> frozenset[str]:
    """Return the names of packages that ROS has and Gazelle has not."""
    return frozenset(_packages())


def what_it_sends(package: str, executable: str) -> Sends:
    """Return what of tf and joint states a node that is not here sends in ROS."""
    program = _programs().get((package, executable))
    if program is not None:
        return program.sends
    row = _row(package)
    return Sends.ANYTHING if row is None else row.sends


def replacement_of(package: str, ros_version: int = 2) -> str:
    """Return what a package of ROS is and what replaces it here; empty when that is not known.

    Args:
        package: its name.
        ros_version: whose commands are named.
    """
    row = _row(package)
    known = "" if row is None else row.instead.format_map(_COMMANDS[ros_version])
    return f"{package} is {known}" if known.startswith(("the ", "a ", "compiled")) else known


def missing_node(package: str, name: str) -> str:
    """Return what a program is that its package has in ROS and not here, and what does its work.

    Empty for programs that are not known: those are misspelt, or the user's.
    """
    known = _programs().get((package, name))
    return f"{name} is {known.instead}" if known is not None else ""


def missing_package(error: NotFoundError, ros_version: int) -> tuple[str, str]:
    """Return what is said of a package that is not found, and what to do about it.

    A package of ROS whose work is done by something here cannot be put into a workspace: most are
    C++.
    """
    # A package of the workspace with nearly this name is meant, unless this one is known itself.
    row = _packages().get(error.name)
    is_other = bool(error.nearest) and (row is None or not row.instead)
    known = "" if is_other else replacement_of(error.name, ros_version)
    text = str(error)
    return (text.partition("\n")[0].partition(";")[0] if known else text), known


def _rows(
    instead: str, names: str, sends: Sends = Sends.ANYTHING
) -> tuple[UnavailablePackage, ...]:
    return tuple(UnavailablePackage(name, instead, sends) for name in names.split())


PACKAGES = (
    *_rows(
        _CAMERA,
        "astra_camera astra_launch azure_kinect_ros_driver camera_ros cv_camera depthai_ros "
        "depthai_ros_driver freenect_camera openni2_camera openni_launch realsense2_camera "
        "usb_cam uvc_camera v4l2_camera zed_wrapper",
    ),
    *_rows(
        _LIDAR,
        "hls_lfcd_lds_driver ld08_driver ldlidar_stl_ros2 ouster_ros rplidar_ros sick_scan "
        "sick_scan2 sick_scan_xd sllidar_ros2 urg_node urg_node2 velodyne velodyne_driver "
        "velodyne_pointcloud ydlidar ydlidar_ros2_driver",
    ),
    *_rows(_BRIDGE, "rosbridge_server web_video_server", Sends.NOTHING),
    *_rows(_BRIDGE, "foxglove_bridge ros1_bridge rosapi rosbridge_suite tf2_web_republisher"),
    *_rows(_MANAGER_PANEL, "rqt_controller_manager"),
    *_rows(_PANEL, "rqt_joint_trajectory_controller"),
    *_rows(_VIEW, "mapviz plotjuggler plotjuggler_ros rviz_visual_tools"),
    *_rows(_JOYSTICK, "joy_teleop", Sends.NOTHING),
    *_rows(_JOYSTICK, "ps3joy spacenav spacenav_node wiimote"),
    *_rows(_MAPPING, "rtabmap_ros", Sends.TRANSFORMS),
    *_rows(
        _MAPPING,
        "hector_geotiff hector_map_server hector_trajectory_server octomap_server "
        "rtabmap_launch rtabmap_slam",
    ),
    *_rows(_MARKER, "interactive_marker_twist_server", Sends.NOTHING),
    *_rows(_DEPTH, "freenect_launch openni2_launch rgbd_launch"),
    *_rows(_SCANS, "dual_laser_merger ira_laser_tools laser_assembler"),
    *_rows(
        _INDUSTRIAL,
        "industrial_core industrial_msgs industrial_robot_client industrial_robot_simulator "
        "industrial_utils",
    ),
    *_rows(_VISION, "depth_image_proc image_proc stereo_image_proc", Sends.NOTHING),
    *_rows(_VISION, "apriltag_ros aruco_ros find_object_2d yolo_ros"),
    *_rows(_FIRMWARE, "mavros micro_ros_agent rosserial_python turtlebot3_node"),
    *_rows(_CONTROL, "ros2_control_test_assets"),
    *_rows(_MOVEIT, "moveit_hybrid_planning moveit_servo"),
    *_rows(_NAV2, "nav2_loopback_sim nav2_route opennav_docking"),
    *_rows(_PICTURES, "image_transport", Sends.NOTHING),
    *_rows(_PICTURES, "image_transport_plugins"),
    *_rows(_HEALTH, "diagnostic_aggregator", Sends.NOTHING),
    *_rows(_HEALTH, "diagnostic_common_diagnostics"),
    *_rows(_ODOMETRY, "laser_scan_matcher rf2o_laser_odometry"),
    *_rows(_IMU, "imu_complementary_filter imu_filter_madgwick imu_transformer"),
    *_rows(_LOCAL, "eband_local_planner mpc_local_planner teb_local_planner"),
    *_rows(_POSES, "odom_to_tf_ros2 robot_pose_publisher"),
    *_rows(_KEYS, "key_teleop mouse_teleop"),
    *_rows(_VELOCITIES, "cmd_vel_mux yocs_velocity_smoother"),
    *_rows(_VELOCITIES, "yocs_cmd_vel_mux", Sends.NOTHING),
    *_rows(_STAMPED, "twist_stamper"),
    *_rows(_BOOT, "robot_upstart"),
    *_rows(_MODELS, "nav2_minimal_tb3_sim nav2_minimal_tb4_sim"),
    *_rows("", _MORE),
)


def _row(package: str) -> UnavailablePackage | None:
    own = _packages().get(package)
    if own is not None and own.instead:
        return own
    return next((row for row in FAMILIES if package.startswith(row.name)), own)


@cache
def _packages() -> dict[str, UnavailablePackage]:
    return {row.name: row for row in PACKAGES}


@cache
def _programs() -> dict[tuple[str, str], UnavailableProgram]:
    return {(row.package, row.executable): row for row in PROGRAMS}
