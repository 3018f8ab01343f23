"""Modules of ROS that Gazelle does not have: what each is, and what does its work."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import NamedTuple

__all__ = ["UNSUPPORTED_MODULES", "UnsupportedModule", "UnsupportedModuleFinder", "why_unsupported"]


class UnsupportedModule(NamedTuple):
    """Why a module is not here.

    Attributes:
        module: its name; those below it are refused with it.
        reason: what it is, and what to do.
    """

    module: str
    reason: str


def _rows(reason: str, *modules: str) -> list[UnsupportedModule]:
    return [UnsupportedModule(module, reason) for module in modules]


_RCLPY = (
    "is rclpy's inside, made around rcl; a node's own methods do its work: create_publisher,"
    " create_subscription, create_timer, create_service, get_topic_names_and_types"
)
_ROSPY = (
    "is rospy's inside, made of XML-RPC and TCPROS; rospy's functions and rosgraph.Master do its"
    " work on Gazelle's graph"
)
_PROGRAM = "is the inside of a command; run the command itself, with subprocess where Python has to"
_LAUNCH1 = (
    "is roslaunch's inside; roslaunch.parent.ROSLaunchParent and roslaunch.scriptapi.ROSLaunch"
    " start launch files and nodes, roslaunch.core has their records"
)
_ROSLIB = "is an old inner module of roslib; rospkg, rosgraph and genpy do its work"
_TESTS = (
    "is the inside of a test runner; write tests with unittest, rostest.rosrun or launch_testing"
)

UNSUPPORTED_MODULES: tuple[UnsupportedModule, ...] = tuple(
    sorted(
        [
            *_rows(
                _RCLPY,
                *("rclpy.action.graph", "rclpy.destroyable", "rclpy.impl.implementation_singleton"),
                *("rclpy.impl.rcutils_logger", "rclpy.logging_service", "rclpy.parameter_service"),
                *("rclpy.service_introspection", "rclpy.time_source", "rclpy.type_hash"),
                *("rclpy.topic_or_service_is_hidden", "rclpy.type_description_service"),
                *("rclpy.type_support", "rclpy.waitable"),
            ),
            *_rows(
                _ROSPY,
                *("rospy.impl", "rospy.logger_level_service_caller"),
                *("rospy.rosconsole", "actionlib.handle_tracker_deleter"),
                *("actionlib.status_tracker", "rosgraph.impl", "rosgraph.roslogging"),
                *("rosgraph.xmlrpc", "ros_numpy.numpy_msg", "ros_numpy.registry"),
            ),
            *_rows(
                _PROGRAM,
                *("rosgraph.rosgraph_main", "rosbag.rosbag_main", "rosbag.migration"),
                *("genpy.generate_initpy", "genpy.generate_numpy", "genpy.generate_struct"),
                *("genpy.generator", "genpy.genpy_main", "moveit_commander.interpreter"),
                *("launch_testing.print_arguments", "tf.tfwtf", "ros_gz_bridge.mappings"),
                *("controller_manager.hardware_spawner", "controller_manager.spawner"),
                *("controller_manager.unspawner", "rostest.rostest_main", "rosunit.rosunit_main"),
            ),
            *_rows(
                "calls the controller manager's services from Python; call them with rospy or rclpy"
                " (/controller_manager/load_controller, switch_controller, list_controllers), or"
                " spawn controllers with controller_manager.launch_utils",
                *(
                    "controller_manager.controller_manager_interface",
                    "controller_manager_msgs.utils",
                ),
                "controller_manager.controller_manager_services",
            ),
            *_rows(
                _LAUNCH1,
                *("roslaunch.arg_dump", "roslaunch.child", "roslaunch.config", "roslaunch.depends"),
                *(
                    "roslaunch.launch",
                    "roslaunch.loader",
                    "roslaunch.netapi",
                    "roslaunch.node_args",
                ),
                *("roslaunch.nodeprocess", "roslaunch.param_dump", "roslaunch.remote"),
                *("roslaunch.remoteprocess", "roslaunch.roslaunch_logs", "roslaunch.server"),
                *("roslaunch.substitution_args", "roslaunch.xmlloader"),
            ),
            *_rows(
                _ROSLIB,
                *("roslib.exceptions", "roslib.gentools", "roslib.launcher", "roslib.manifest"),
                *("roslib.manifestlib", "roslib.msgs", "roslib.network"),
                *("roslib.resources", "roslib.rosenv", "roslib.rospack", "roslib.scriptutil"),
                *("roslib.srvs", "roslib.stack_manifest", "roslib.stacks"),
            ),
            *_rows(
                "is a module of rospkg's inside; everything public is in rospkg itself:"
                " rospkg.RosPack, rospkg.get_ros_home",
                *("rospkg.distro", "rospkg.manifest"),
                *("rospkg.os_detect", "rospkg.rosversion", "rospkg.stack"),
            ),
            *_rows(
                "is genpy's inside; messages have serialize and deserialize, and genpy the rest",
                *("genpy.base", "genpy.dynamic"),
            ),
            *_rows(
                _TESTS,
                *("rostest.rostest_parent", "rostest.rostestutil", "rostest.runner"),
                *("rosunit.baretest", "rosunit.core", "rosunit.junitxml", "rosunit.pmon"),
                *("rosunit.pyunit", "rosunit.xmlrunner", "launch_testing.legacy"),
                *("launch_testing.parametrize", "launch_testing.pytest.hookspecs"),
                *("launch_testing.ready_to_test_action_timeout", "launch_testing_ros.pytest"),
                *("launch_pytest.fixture", "launch.actions.conftest"),
            ),
            *_rows(
                "is part of a package on PyPI that runs without ROS: pip install osrf-pycommon",
                "osrf_pycommon",
            ),
            *_rows(
                "ends with a NameError in urdf_parser_py too; gz sdf -p reads SDF, and"
                " xml.etree.ElementTree its XML",
                "urdf_parser_py.sdf",
            ),
            *_rows(
                "shows a URDF file as text; print(urdf_parser_py.urdf.URDF.from_xml_file(PATH))",
                "urdf_parser_py.display_urdf",
            ),
            *_rows(
                "makes messages of identifiers; str(uuid.uuid4()) of Python's uuid does its work",
                "unique_id",
            ),
            *_rows(
                "needs PyKDL, a C++ library; tf2_geometry_msgs and tf.transformations do its work",
                *("tf2_kdl", "tf_conversions.posemath"),
            ),
            *_rows(
                "is a program that shows diagnostic_updater's use; its classes are there",
                "diagnostic_updater.example",
            ),
            *_rows("is not among what Gazelle has; exchange a topic of your own", "bondpy"),
            *_rows(
                "is one of Nav2's Python tools that are not here; nav2_simple_commander"
                ".robot_navigator is",
                *("nav2_simple_commander.occupancy_grid", "nav2_simple_commander.utils"),
                *("nav2_simple_commander.demo_inspection", "nav2_simple_commander.demo_picking"),
                *("nav2_simple_commander.demo_recoveries", "nav2_simple_commander.demo_security"),
                *("nav2_simple_commander.example_assisted_teleop",),
                *("nav2_simple_commander.example_follow_path",),
                *("nav2_simple_commander.example_nav_through_poses",),
                *("nav2_simple_commander.example_nav_to_pose",),
                *("nav2_simple_commander.example_route",),
                *("nav2_simple_commander.example_waypoint_follower",),
            ),
            *_rows(
                "is an inner module; what is public of it is in the package it belongs to",
                *("launch.utilities.typing_file_path", "launch_ros.utilities.plugin_support"),
                *("rosidl_runtime_py.import_message", "sensor_msgs_py.numpy_compat"),
                *("tf2_ros.buffer_client",),
            ),
        ]
    )
)
_BY_MODULE = {row.module: row for row in UNSUPPORTED_MODULES}


def why_unsupported(name: str) -> str | None:
    """Return the sentence for a module that is refused, or None."""
    parts = name.split(".")
    for count in range(len(parts), 0, -1):
        row = _BY_MODULE.get(".".join(parts[:count]))
        if row is not None:
            return f"No module named '{name}': gazelle: it {row.reason}"
    return None


class UnsupportedModuleFinder:
    """Tells why a module is not here; it stands behind every other finder."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Find nothing.

        Raises:
            ModuleNotFoundError: the module is one that is refused; with the sentence.
        """
        sentence = why_unsupported(fullname)
        if sentence is not None:
            raise ModuleNotFoundError(sentence, name=fullname)
        return None
