"""Every command with the module that runs it and one line of help."""

from __future__ import annotations

from typing import NamedTuple

from gazelle.cli.rqt import VIEW_COMMANDS

__all__ = ["COMMANDS", "Command"]


class Command(NamedTuple):
    """A command: `module` has ``main(argv) -> int``."""

    module: str
    help: str


COMMANDS: dict[str, Command] = {
    "demo": Command("gazelle.cli.demo", "run a demo: a robot, its world and the page"),
    "env": Command("gazelle.cli.env", "print shell lines that make the ROS commands available"),
    "complete": Command("gazelle.cli.completion", "print what may follow the words of a command"),
    "shell": Command("gazelle.cli.shell", "start a shell with the ROS commands and modules"),
    "roscore": Command("gazelle.cli.roscore", "run the graph's hub and parameter store"),
    "roslaunch": Command("gazelle.cli.roslaunch", "start what launch files name"),
    "rosrun": Command("gazelle.cli.rosrun", "run a node of a package"),
    "rostopic": Command("gazelle.cli.rostopic", "list, echo, hz, bw, info, type, find, pub"),
    "rosnode": Command("gazelle.cli.rosnode", "list, info, ping, kill, machine, cleanup"),
    "rosservice": Command("gazelle.cli.rosservice", "list, info, type, find, call, args, uri"),
    "rosparam": Command("gazelle.cli.rosparam", "list, get, set, load, dump, delete"),
    "rosmsg": Command("gazelle.cli.rosmsg", "show, info, list, md5, package, packages"),
    "rossrv": Command("gazelle.cli.rosmsg", "the same for services"),
    "bag": Command("gazelle.cli.bag", "convert bags between formats, export them to files"),
    "rosbag": Command(
        "gazelle.cli.rosbag", "record, play, info, filter, check, compress, reindex bags"
    ),
    "rospack": Command("gazelle.cli.rospack", "find, list, list-names, depends, depends1"),
    "rosversion": Command("gazelle.cli.rospack", "version of a package"),
    "rostest": Command("gazelle.cli.rostest", "run the tests of a launch file"),
    "launch_test": Command("gazelle.cli.launch_test", "run the tests of a ROS 2 launch"),
    "roswtf": Command("gazelle.cli.roswtf", "look for what is wrong in files and in the graph"),
    "rosclean": Command("gazelle.cli.rosclean", "check, purge: log files of nodes"),
    "gzserver": Command("gazelle.cli.gzserver", "run a world"),
    "gazebo": Command("gazelle.cli.gazebo", "run a world and show it"),
    "spawn_model": Command("gazelle.cli.spawn_model", "put a model into a running world"),
    "controller_manager": Command(
        "gazelle.cli.controller_manager", "list, load, start, stop, spawn, kill controllers"
    ),
    "ros2": Command("gazelle.cli.ros2", "commands of ROS 2: topic, node, service, run, param …"),
    "dynparam": Command(
        "gazelle.cli.dynparam", "list, get, set, load, dump parameters of dynamic_reconfigure"
    ),
    "tf_echo": Command("gazelle.cli.tf_echo", "print a transform between two frames"),
    "tf_monitor": Command("gazelle.cli.tf_monitor", "print delays and rates of frames"),
    "view_frames": Command("gazelle.cli.view_frames", "draw the tree of frames"),
    "bridge": Command("gazelle.cli.bridge", "join real ROS and viewers: ros1, foxglove"),
    "doctor": Command(
        "gazelle.cli.doctor", "find what would go wrong in a package, file or launch"
    ),
    "inertia": Command("gazelle.cli.inertia", "mass properties of bodies; check a robot's"),
    "slam": Command("gazelle.cli.slam", "make a map and a trajectory of a log or bag"),
    "xacro": Command("gazelle.cli.xacro", "expand a xacro file"),
    "check_urdf": Command("gazelle.cli.check_urdf", "check a robot and print its tree"),
    "urdf_to_graphviz": Command("gazelle.cli.urdf_to_graphviz", "draw a robot's tree"),
    "urdf_to_graphiz": Command("gazelle.cli.urdf_to_graphiz", "old name of urdf_to_graphviz"),
    "gz": Command(
        "gazelle.cli.gz.command", "gz of Gazebo: sim, topic, service, model, world, sdf …"
    ),
    "ign": Command("gazelle.cli.gz.ign", "ign of Fortress: gazebo, topic, service, model, sdf"),
    "studio": Command("gazelle.cli.studio", "open the browser page on a running graph"),
    "view": Command("gazelle.cli.view", "draw a robot, a model or a world into a PNG file"),
    "record": Command("gazelle.cli.record", "record a run as a replay page, a film or a picture"),
    "convert": Command("gazelle.cli.convert", "write a robot or world as URDF, SDF or MJCF"),
    "catkin_create_pkg": Command("gazelle.cli.catkin_create_pkg", "write a package for ROS 1"),
    "catkin": Command("gazelle.cli.catkin", "build, init, config, clean, list, locate"),
    "catkin_make": Command("gazelle.cli.catkin_make", "build a workspace of ROS 1"),
    "rosdep": Command("gazelle.cli.rosdep", "what packages need: install, check, keys"),
    "colcon": Command("gazelle.cli.colcon", "build, test, list, info, graph a workspace"),
    "warm": Command("gazelle.cli.warm", "compile all kernels ahead, on all cores"),
    "new": Command("gazelle.cli.new", "write a package: robot, world, package, moveit_config"),
    **{name: Command("gazelle.cli.rqt", text) for name, (_, text) in VIEW_COMMANDS.items()},
}
