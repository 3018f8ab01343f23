"""Packages of ROS that are not here: what they are, and what does their work."""

from __future__ import annotations

from gazelle.errors import NotFoundError

__all__ = ["missing_node", "missing_package", "replacement_of"]

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
_NODELETS = "compiled parts that share a process; what they do is done by nodes where it is here"
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

_KNOWN = {
    **dict.fromkeys(("usb_cam", "v4l2_camera", "uvc_camera", "cv_camera", "camera_ros"), _CAMERA),
    **dict.fromkeys(
        ("realsense2_camera", "openni2_camera", "openni_launch", "zed_wrapper"), _CAMERA
    ),
    **dict.fromkeys(("depthai_ros_driver", "depthai_ros", "azure_kinect_ros_driver"), _CAMERA),
    **dict.fromkeys(("astra_camera", "astra_launch", "freenect_camera"), _CAMERA),
    **dict.fromkeys(("rplidar_ros", "sllidar_ros2", "urg_node", "urg_node2", "ydlidar"), _LIDAR),
    **dict.fromkeys(("sick_scan", "sick_scan2", "sick_scan_xd", "velodyne", "ld08_driver"), _LIDAR),
    **dict.fromkeys(("velodyne_driver", "velodyne_pointcloud", "ouster_ros"), _LIDAR),
    **dict.fromkeys(("hls_lfcd_lds_driver", "ydlidar_ros2_driver", "ldlidar_stl_ros2"), _LIDAR),
    **dict.fromkeys(("rosbridge_server", "rosbridge_suite", "foxglove_bridge", "rosapi"), _BRIDGE),
    **dict.fromkeys(("ros1_bridge", "web_video_server"), _BRIDGE),
    "rqt_controller_manager": _MANAGER_PANEL,
    "rqt_joint_trajectory_controller": _PANEL,
    **dict.fromkeys(("plotjuggler", "plotjuggler_ros", "mapviz", "rviz_visual_tools"), _VIEW),
    **dict.fromkeys(("joy_teleop", "spacenav", "spacenav_node", "ps3joy", "wiimote"), _JOYSTICK),
    **dict.fromkeys(("rtabmap_ros", "rtabmap_slam", "rtabmap_launch", "octomap_server"), _MAPPING),
    "interactive_marker_twist_server": _MARKER,
    "nodelet": _NODELETS,
    "tf2_web_republisher": _BRIDGE,
    **dict.fromkeys(("rgbd_launch", "openni2_launch", "freenect_launch"), _DEPTH),
    **dict.fromkeys(("ira_laser_tools", "pointcloud_to_laserscan"), _SCANS),
    **dict.fromkeys(("industrial_robot_client", "industrial_robot_simulator"), _INDUSTRIAL),
    **dict.fromkeys(("industrial_msgs", "industrial_core", "industrial_utils"), _INDUSTRIAL),
    **dict.fromkeys(("image_proc", "stereo_image_proc", "depth_image_proc"), _VISION),
    **dict.fromkeys(("apriltag_ros", "aruco_ros", "find_object_2d", "yolo_ros"), _VISION),
    **dict.fromkeys(
        ("micro_ros_agent", "rosserial_python", "turtlebot3_node", "mavros"), _FIRMWARE
    ),
    **dict.fromkeys(("ros2_control_test_assets", "controller_interface"), _CONTROL),
    **dict.fromkeys(("moveit_servo", "moveit_setup_assistant", "moveit_hybrid_planning"), _MOVEIT),
    **dict.fromkeys(("nav2_route", "opennav_docking"), _NAV2),
    **dict.fromkeys(("nav2_loopback_sim", "nav2_smac_planner"), _NAV2),
    **dict.fromkeys(("image_transport", "image_transport_plugins"), _PICTURES),
    **dict.fromkeys(("diagnostic_aggregator", "diagnostic_common_diagnostics"), _HEALTH),
    **dict.fromkeys(("laser_scan_matcher", "rf2o_laser_odometry"), _ODOMETRY),
    **dict.fromkeys(("imu_filter_madgwick", "imu_complementary_filter", "imu_transformer"), _IMU),
    **dict.fromkeys(("laser_assembler", "dual_laser_merger"), _SCANS),
    **dict.fromkeys(("teb_local_planner", "eband_local_planner", "mpc_local_planner"), _LOCAL),
    **dict.fromkeys(("robot_pose_publisher", "odom_to_tf_ros2"), _POSES),
    **dict.fromkeys(("key_teleop", "mouse_teleop"), _KEYS),
    **dict.fromkeys(("hector_trajectory_server", "hector_geotiff", "hector_map_server"), _MAPPING),
    **dict.fromkeys(("cmd_vel_mux", "yocs_cmd_vel_mux", "yocs_velocity_smoother"), _VELOCITIES),
    "twist_stamper": _STAMPED,
    "robot_upstart": _BOOT,
    **dict.fromkeys(("nav2_minimal_tb3_sim", "nav2_minimal_tb4_sim"), _MODELS),
}
# Programs of packages that are stood in for, and what does their work; everything else of these
# packages runs.
_UKF = "the unscented filter; `{}` fuses the same inputs with the same parameters"
_GPS = "for positions of satellites; robot_localization's pose0 takes poses"
_NODES = {
    ("joy", "game_controller_node"): "SDL's layout of game controllers; `joy_node` sends the same "
    "topic in the kernel's order of axes and buttons",
    ("robot_localization", "ukf_localization_node"): _UKF.format("ekf_localization_node"),
    ("robot_localization", "ukf_node"): _UKF.format("ekf_node"),
    ("robot_localization", "navsat_transform_node"): _GPS,
    ("robot_localization", "robot_localization_listener_node"): "for poses at other times; tf2_ros "
    "looks them up",
    ("pointcloud_to_laserscan", "laserscan_to_pointcloud_node"): "for clouds of scans; "
    "laser_geometry's Python module makes them",
    ("laser_filters", "scan_to_cloud_filter_chain"): "for clouds of filtered scans; "
    "`scan_to_scan_filter_chain` and laser_geometry's Python module do both steps",
    ("laser_filters", "generic_laser_filter_node"): "an older name; `scan_to_scan_filter_chain` "
    "filters scans",
    ("slam_toolbox", "merge_maps_kinematic"): "for putting maps together by hand; one mapping "
    "run over both places makes one map",
    ("cartographer_ros", "cartographer_offline_node"): "for bags without time; `cartographer_node` "
    "maps while `rosbag play` plays",
    ("nav2_map_server", "costmap_filter_info_server"): "for keep-out masks; costmap filters are "
    "not here, an obstacle in the map keeps robots out",
    ("tf2_ros", "buffer_server"): "for look-ups by an action; nodes listen to /tf themselves",
    ("topic_tools", "delay"): "for late copies of a topic; `relay` copies without a delay",
    ("ros_gz_bridge", "static_bridge"): "for a single topic; `parameter_bridge` bridges any",
    **{
        ("image_view", name): "compiled code that works on images; `image_view` and "
        "`rosbag record` show and keep them"
        for name in ("extract_images", "image_saver", "stereo_view", "video_recorder")
    },
}
_FAMILIES = {"rqt_": _PANEL, "yocs_": _VELOCITIES}


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


def replacement_of(package: str, ros_version: int = 2) -> str:
    """Return what a package of ROS is and what replaces it here; empty when that is not known.

    Args:
        package: its name.
        ros_version: whose commands are named.
    """
    known = _KNOWN.get(package, "")
    if not known:
        known = next((text for start, text in _FAMILIES.items() if package.startswith(start)), "")
    known = known.format_map(_COMMANDS[ros_version])
    return f"{package} is {known}" if known.startswith(("the ", "a ", "compiled")) else known


def missing_node(package: str, name: str) -> str:
    """Return what a program is that its package has in ROS and not here, and what does its work.

    Empty for programs that are not known: those are misspelt, or the user's.
    """
    known = _NODES.get((package, name), "")
    return f"{name} is {known}" if known else ""


def missing_package(error: NotFoundError, ros_version: int) -> tuple[str, str]:
    """Return what is said of a package that is not found, and what to do about it.

    A package of ROS whose work is done by something here cannot be put into a workspace: most are
    C++.
    """
    # A package of the workspace with nearly this name is meant, unless this one is known itself.
    is_other = bool(error.nearest) and error.name not in _KNOWN
    known = "" if is_other else replacement_of(error.name, ros_version)
    text = str(error)
    return (text.partition("\n")[0].partition(";")[0] if known else text), known
