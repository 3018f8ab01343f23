"""Packages of ROS that are not here: what they are, and what does their work."""

from __future__ import annotations

from gazelle.errors import NotFoundError

__all__ = ["missing_package", "replacement_of"]

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
    **dict.fromkeys(("nav2_minimal_tb3_sim", "nav2_minimal_tb4_sim"), _MODELS),
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
