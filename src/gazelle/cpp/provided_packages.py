"""What ``find_package`` finds of ours, a row for each name: libraries, targets, variables.

Packages of messages need no row: those are all that Gazelle's interfaces know. Every package that
is found has the targets ``name::name`` and the variables ``name_LIBRARIES``, ``name_INCLUDE_DIRS``
and ``name_TARGETS``, as catkin and ament make them. A name that is refused is found as well, so
that what stands beside it is built; targets that use it are left out and told.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = [
    "PROVIDED",
    "REFUSED",
    "REFUSED_BEGINNINGS",
    "REFUSED_IN_ROS2",
    "ProvidedPackage",
    "provided",
    "refusal",
]


@dataclass(frozen=True, slots=True)
class ProvidedPackage:
    """A package of ROS, or a library that ROS packages look for, whose headers are ours.

    Attributes:
        name: as in ``find_package``.
        libraries: runtime libraries that it means.
        generations: the ROS that it belongs to.
        targets: names of CMake targets beside ``name::name``.
        scripts: files below ``cmake`` that bring its functions.
        variables: names in front of ``_LIBRARIES`` and so on, beside the package's.
    """

    name: str
    libraries: tuple[str, ...] = ()
    generations: tuple[int, ...] = (1, 2)
    targets: tuple[str, ...] = ()
    scripts: tuple[str, ...] = ()
    variables: tuple[str, ...] = ()


def _ros1(name: str, *libraries: str, targets: tuple[str, ...] = ()) -> ProvidedPackage:
    return ProvidedPackage(name, libraries or ("roscpp",), (1,), targets)


def _ros2(name: str, *libraries: str, targets: tuple[str, ...] = ()) -> ProvidedPackage:
    return ProvidedPackage(name, libraries or ("rclcpp",), (2,), targets)


_ROWS = (
    # Build systems and generators.
    ProvidedPackage("catkin", (), (1,), scripts=("catkin",)),
    ProvidedPackage("catkin_simple", (), (1,), scripts=("catkin", "messages", "catkin_simple")),
    ProvidedPackage("rosbuild", (), (1,), scripts=("rosbuild",)),
    ProvidedPackage("genmsg", (), (1,), scripts=("messages",)),
    ProvidedPackage("message_generation", (), (1,), scripts=("messages",)),
    ProvidedPackage("message_runtime", ("roscpp",), (1,)),
    ProvidedPackage("cmake_modules", (), (1,)),
    ProvidedPackage("roslaunch", (), (1,), scripts=("roslaunch",)),
    ProvidedPackage("rostest", (), (1,), scripts=("rostest",)),
    ProvidedPackage("roslint", (), (1,), scripts=("roslint",)),
    ProvidedPackage("ament_cmake", (), (2,), scripts=("ament",)),
    ProvidedPackage("ament_cmake_auto", (), (2,), scripts=("ament", "ament_auto")),
    ProvidedPackage("ament_cmake_ros", (), (2,), scripts=("ament", "ament_ros")),
    *(
        ProvidedPackage(name, (), (2,), scripts=("ament",))
        for name in (
            "ament_cmake_core",
            "ament_cmake_export_dependencies",
            "ament_cmake_export_targets",
            "ament_cmake_gmock",
            "ament_cmake_google_benchmark",
            "ament_cmake_gtest",
            "ament_cmake_libraries",
            "ament_cmake_pytest",
            "ament_cmake_python",
            "ament_cmake_target_dependencies",
            "ament_index",
            "ament_lint_auto",
            "ament_lint_common",
            "ament_cmake_uncrustify",
            "ament_cmake_cppcheck",
            "ament_cmake_cpplint",
            "ament_cmake_lint_cmake",
            "ament_cmake_copyright",
            "ament_cmake_flake8",
            "ament_cmake_pep257",
            "ament_cmake_xmllint",
            "ament_cmake_clang_format",
            "launch_testing_ament_cmake",
        )
    ),
    ProvidedPackage("rosidl_default_generators", ("rclcpp",), (2,), scripts=("rosidl",)),
    ProvidedPackage("rosidl_default_runtime", ("rclcpp",), (2,)),
    ProvidedPackage("rosidl_cmake", (), (2,), scripts=("rosidl",)),
    ProvidedPackage(
        "generate_parameter_library", ("rclcpp",), (2,), scripts=("parameter_library",)
    ),
    ProvidedPackage("backward_ros", (), (2,)),
    ProvidedPackage("eigen3_cmake_module", (), (2,)),
    ProvidedPackage("ros2_control_cmake", (), (2,), scripts=("ros2_control_cmake",)),
    # ROS 1.
    *(
        _ros1(name)
        for name in (
            "cpp_common",
            "message_filters",
            "rosconsole",
            "roscpp",
            "roscpp_serialization",
            "roscpp_traits",
            "roslib",
            "rostime",
            "rosconsole_bridge",
            "topic_tools",
            "xmlrpcpp",
            "actionlib",
            "diagnostic_updater",
            "ros_type_introspection",
            "rospack",
            "self_test",
            "bondcpp",
            "smclib",
            "cv_bridge",
            "image_geometry",
            "pcl_conversions",
            "pcl_ros",
            "rospy",
            "roscpp_core",
        )
    ),
    ProvidedPackage(
        "dynamic_reconfigure", ("dynamic_reconfigure",), (1,), scripts=("dynamic_reconfigure",)
    ),
    _ros1("nodelet", "nodelet"),
    _ros1("image_transport", "image_transport"),
    _ros1("camera_info_manager", "camera_info_manager"),
    _ros1("camera_calibration_parsers", "camera_info_manager"),
    _ros1("rosbag", "rosbag"),
    _ros1("rosbag_storage", "rosbag"),
    _ros1("tf2_ros", "tf2_ros1"),
    *(_ros1(name, "tf2_ros1") for name in ("tf2_geometry_msgs", "tf2_eigen", "tf2_sensor_msgs")),
    _ros1("tf2_kdl", "tf2_ros1", "kdl"),
    _ros1("tf", "tf"),
    _ros1("tf_conversions", "tf", "kdl"),
    _ros1("kdl_conversions", "roscpp", "kdl"),
    _ros1("eigen_conversions", "roscpp", "kdl"),
    _ros1("laser_geometry", "tf"),
    _ros1("geometry", "tf", "kdl"),
    # ROS 2.
    *(
        _ros2(name)
        for name in (
            "rcl",
            "rcl_action",
            "rcl_lifecycle",
            "rcl_yaml_param_parser",
            "rcl_logging_interface",
            "rclcpp",
            "rcpputils",
            "rcutils",
            "rmw",
            "rmw_implementation",
            "rmw_implementation_cmake",
            "rmw_fastrtps_cpp",
            "rosidl_runtime_c",
            "rosidl_runtime_cpp",
            "rosidl_typesupport_cpp",
            "rosidl_typesupport_c",
            "rosidl_typesupport_interface",
            "rosidl_generator_cpp",
            "rosidl_typesupport_introspection_cpp",
            "rosidl_dynamic_typesupport",
            "tracetools",
            "libstatistics_collector",
            "image_transport",
            "message_filters",
            "camera_info_manager",
            "diagnostic_updater",
            "cv_bridge",
            "image_geometry",
            "pcl_conversions",
            "pcl_ros",
            "parameter_traits",
            "rsl",
            "tl_expected",
            "tcb_span",
            "ament_index_cpp",
            "camera_calibration_parsers",
            "topic_tools",
            "rosbag2_cpp",
            "rosbag2_storage",
            "lifecycle",
            "rclpy",
            "rosidl_adapter",
        )
    ),
    _ros2("rclcpp_action", "rclcpp_action"),
    _ros2("rclcpp_lifecycle", "rclcpp_lifecycle"),
    ProvidedPackage(
        "rclcpp_components",
        ("rclcpp_components",),
        (2,),
        ("rclcpp_components::component", "rclcpp_components::component_manager"),
        ("components",),
    ),
    _ros2("tf2_ros", "tf2_ros2", targets=("tf2_ros::static_transform_broadcaster_node",)),
    *(_ros2(name, "tf2_ros2") for name in ("tf2_geometry_msgs", "tf2_eigen", "tf2_sensor_msgs")),
    _ros2("tf2_kdl", "tf2_ros2", "kdl"),
    # Robots and their control.
    *(
        _ros1(name, "control")
        for name in (
            "control_toolbox",
            "realtime_tools",
            "pr2_controller_interface",
            "pr2_controller_manager",
            "pr2_hardware_interface",
            "pr2_mechanism_model",
        )
    ),
    _ros2("realtime_tools", targets=("realtime_tools::thread_priority",)),
    *(
        _ros1(name, "moveit1")
        for name in (
            "moveit_core",
            "moveit_ros_planning",
            "moveit_ros_planning_interface",
            "moveit_visual_tools",
            "rviz_visual_tools",
        )
    ),
    *(
        _ros2(name, "moveit2")
        for name in (
            "moveit_core",
            "moveit_ros_planning",
            "moveit_ros_planning_interface",
            "moveit_visual_tools",
            "rviz_visual_tools",
        )
    ),
    _ros1("interactive_markers"),
    _ros2("interactive_markers"),
    ProvidedPackage("urdf", ("urdf",)),
    ProvidedPackage("kdl_parser", ("urdf", "kdl")),
    ProvidedPackage("resource_retriever", ("core",)),
    *(
        ProvidedPackage(name, ("urdf",), targets=(f"{name}::{name}", "urdfdom_model"))
        for name in ("urdfdom", "urdfdom_headers", "urdf_parser_plugin")
    ),
    _ros2("tf2_eigen_kdl", "tf2_ros2", "kdl"),
    _ros2("eigen_kdl", "kdl"),
    _ros2("laser_geometry", "tf2_ros2"),
    # Both.
    ProvidedPackage("angles", targets=("angles",)),
    ProvidedPackage("orocos_kdl", ("kdl",), targets=("orocos-kdl",), variables=("OROCOS_KDL",)),
    ProvidedPackage("orocos-kdl", ("kdl",), targets=("orocos-kdl::orocos-kdl",)),
    ProvidedPackage("orocos_kdl_vendor", ("kdl",)),
    ProvidedPackage("console_bridge", ("core",)),
    ProvidedPackage("tf2", ("tf2",)),
    ProvidedPackage("class_loader", ("class_loader",), scripts=("class_loader",)),
    ProvidedPackage("pluginlib", ("class_loader",), scripts=("pluginlib",)),
)

PROVIDED: tuple[ProvidedPackage, ...] = _ROWS


_GAZEBO = "plug-ins of Gazebo are written against its libraries, which are not here"
_GZ = "plug-ins of gz are written against its libraries, which are not here"
_RVIZ = "displays and panels of RViz are not run; Studio shows the robot"
_RQT = "plug-ins of rqt are not run; Studio has panels of its own"
_NAV = "plug-ins of the navigation stack are not loaded; the built-in planners are used"
_CONTROL = "controllers and hardware of C++ are not loaded; the built-in controllers are used"

REFUSED: dict[str, str] = {
    **dict.fromkeys(
        ("gazebo", "gazebo_dev", "gazebo_plugins", "gazebo_ros", "gazebo_ros_control",
         "gazebo_msgs_plugins", "gazebo_ros2_control", "gazebo_ros_pkgs"),
        _GAZEBO,
    ),
    **dict.fromkeys(
        ("ros_gz_bridge", "ros_gz_sim", "ros_ign_bridge", "ros_ign_gazebo", "gz_ros2_control",
         "ign_ros2_control", "gz_plugin_vendor", "gz_sim_vendor", "sdformat_vendor"),
        _GZ,
    ),
    **dict.fromkeys(
        ("rviz", "rviz_common", "rviz_rendering", "rviz_default_plugins", "rviz_ogre_vendor"), _RVIZ
    ),
    **dict.fromkeys(("rqt_gui", "rqt_gui_cpp", "qt_gui_cpp", "rqt_gui_py"), _RQT),
    **dict.fromkeys(
        ("nav_core", "nav2_core", "costmap_2d", "nav2_costmap_2d", "base_local_planner",
         "nav2_util", "nav2_behavior_tree", "nav_core2", "navfn", "move_base"),
        _NAV,
    ),
}  # fmt: skip
"""Names that are looked for in vain, and why."""

REFUSED_BEGINNINGS = {"gz-": _GZ, "ignition-": _GZ, "sdformat": _GZ, "rviz_": _RVIZ, "rqt_": _RQT}
REFUSED_IN_ROS2 = dict.fromkeys(
    ("controller_interface", "hardware_interface", "controller_manager",
     "transmission_interface", "ros2_control_test_assets"),
    _CONTROL,
)  # fmt: skip


def refusal(name: str, generation: int) -> str:
    """Return why a package is refused, empty where it is not.

    Args:
        name: as in ``find_package``.
        generation: of ROS.
    """
    if name in REFUSED:
        return REFUSED[name]
    if generation == 2 and name in REFUSED_IN_ROS2:
        return REFUSED_IN_ROS2[name]
    return next((why for start, why in REFUSED_BEGINNINGS.items() if name.startswith(start)), "")


def provided(generation: int) -> dict[str, ProvidedPackage]:
    """Return the rows of a ROS by name."""
    return {row.name: row for row in PROVIDED if generation in row.generations}
