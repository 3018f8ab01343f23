"""Codes of the bridges to real ROS and to viewers."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

_ROS1_AND_VIEWERS = (
    Entry(
        "bridge.foxglove-port-taken",
        "error",
        "The bridge for Foxglove cannot listen on its port",
        "Another program, perhaps another bridge, has the port, or the address is not one of this "
        "machine.",
        "end the other program, or choose another port with --port",
        "Couldn't initialize websocket server",
    ),
    Entry(
        "bridge.master-port-taken",
        "error",
        "The port of the ROS 1 master belongs to another program",
        "The bridge is the master where none runs, and nodes look for it at ROS_MASTER_URI.",
        "end that program, or choose another port in ROS_MASTER_URI in all shells",
        "Unable to start XML-RPC server, port 11311 is already in use",
    ),
    Entry(
        "bridge.no-master",
        "error",
        "No ROS 1 master answers on the machine that ROS_MASTER_URI names",
        "The bridge is the master only on its own machine.",
        "start roscore there, or point ROS_MASTER_URI at this machine",
        "Unable to register with master node: master may not be running yet. Will keep trying.",
    ),
    Entry(
        "bridge.no-foxglove-sdk",
        "error",
        "The bridge for Foxglove needs the package foxglove-sdk",
        "It has the WebSocket server that viewers connect to, and weighs too much (19 MB) for "
        "those who never use one.",
        "pip install 'gazelle-sim[foxglove]'",
        "No module named 'foxglove'",
    ),
    Entry(
        "bridge.not-open",
        "error",
        "ROS_MASTER_URI names this machine as others reach it",
        "The bridge keeps to this machine unless ROS_HOSTNAME or ROS_IP open it, so nobody would "
        "find the master there.",
        "say localhost in ROS_MASTER_URI, or set ROS_HOSTNAME",
        "Unable to communicate with master!",
    ),
    Entry(
        "bridge.second",
        "error",
        "Another bridge of the same kind runs on the graph",
        "Two of them would carry each message over twice, and back again.",
        "end the other one (gazelle rosnode kill /ros1_bridge), or use it",
        "",
    ),
)

_ROS2 = (
    Entry(
        "bridge.no-rclpy",
        "error",
        "No Python with ROS 2's rclpy was found",
        "The bridge to ROS 2 runs ROS's own rclpy in ROS's own Python.",
        "source ROS 2's setup.bash first, or name its Python with --python",
        "ModuleNotFoundError: No module named 'rclpy'",
    ),
    Entry(
        "bridge.qos-adapted",
        "warning",
        "A publisher of the graph offers less than a subscription in ROS 2 asks for",
        "The bridge offers what is asked for, so the messages arrive; between two real ROS 2 nodes "
        "none would.",
        "give both sides the same reliability and durability",
        "requesting incompatible QoS. No messages will be sent to it. Last incompatible policy:",
    ),
    Entry(
        "bridge.qos-mixed",
        "warning",
        "The publishers of a topic in ROS 2 differ in durability",
        "A subscription hears latched messages of earlier times only if it asks all publishers for "
        "them, and then it does not hear those that offer none.",
        "give all publishers of the topic the same durability",
        "",
    ),
    Entry(
        "bridge.type-differs",
        "warning",
        "The two sides of the bridge to ROS 2 define a type differently",
        "Messages cross as bytes, so the other side would read wrong values. Distributions of "
        "ROS 2 change their messages now and then.",
        "give both sides the same version of the package that defines it",
        "type hash mismatch",
    ),
    Entry(
        "bridge.type-missing",
        "warning",
        "A type is known on one side of the bridge to ROS 2 only",
        "Its messages cannot be made or read on the other side.",
        "install the package that defines it on the side that lacks it",
        "The message type is invalid",
    ),
)

ENTRIES = (*_ROS1_AND_VIEWERS, *_ROS2)
