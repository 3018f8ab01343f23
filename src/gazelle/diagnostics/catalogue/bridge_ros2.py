"""Codes of the bridge to real ROS 2."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
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
