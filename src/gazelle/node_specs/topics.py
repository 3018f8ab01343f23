"""What records, plays, copies and chooses topics; components; the log."""

from __future__ import annotations

from gazelle.node_specs.spec import ROS_1, ROS_2, NodeName, NodeRole, NodeSpec

__all__ = ["TOPICS"]

TOPICS = (
    NodeSpec(
        package="rosbag",
        executable="record",
        ros=ROS_1,
        entry="gazelle.nodes.rosbag.record:run",
        does="records topics into a bag",
        is_light=False,
        writes_at_end=True,
    ),
    NodeSpec(
        package="rosbag",
        executable="play",
        ros=ROS_1,
        entry="gazelle.nodes.rosbag.play:run",
        does="plays a bag",
        is_light=False,
    ),
    NodeSpec(
        package="rclcpp_components",
        executable="component_container",
        ros=ROS_2,
        entry="gazelle.nodes.component_container:run",
        does="runs built-in nodes under the names of components",
        is_light=False,
        aliases=(
            NodeName("rclcpp_components", "component_container_mt", ROS_2),
            NodeName("rclcpp_components", "component_container_isolated", ROS_2),
            NodeName("rclcpp_components", "component_container_event", ROS_2),
        ),
        name="ComponentManager",
    ),
    NodeSpec(
        package="rosout",
        executable="rosout",
        ros=ROS_1,
        entry="gazelle.nodes.rosout:run",
        does="collects log messages",
        is_light=True,
    ),
    NodeSpec(
        package="topic_tools",
        executable="relay",
        entry="gazelle.nodes.topic_tools:run_relay",
        does="publishes every message of a topic again",
        is_light=True,
        role=NodeRole.RELAY,
    ),
    NodeSpec(
        package="topic_tools",
        executable="throttle",
        entry="gazelle.nodes.topic_tools:run_throttle",
        does="publishes so many messages a second of a topic",
        is_light=True,
        role=NodeRole.RELAY,
    ),
    NodeSpec(
        package="topic_tools",
        executable="drop",
        entry="gazelle.nodes.topic_tools:run_drop",
        does="leaves out some messages of a topic",
        is_light=True,
        role=NodeRole.RELAY,
    ),
    NodeSpec(
        package="topic_tools",
        executable="transform",
        entry="gazelle.nodes.topic_transform:run_transform",
        does="publishes what a Python expression makes of a topic or a field",
        is_light=True,
    ),
    NodeSpec(
        package="topic_tools",
        executable="relay_field",
        entry="gazelle.nodes.topic_transform:run_relay_field",
        does="fills messages with fields of another topic",
        is_light=True,
    ),
    NodeSpec(
        package="topic_tools",
        executable="mux",
        entry="gazelle.nodes.topic_mux:run_mux",
        does="publishes one of several topics, which services select",
        is_light=True,
    ),
    NodeSpec(
        package="topic_tools",
        executable="demux",
        ros=ROS_1,
        entry="gazelle.nodes.topic_mux:run_demux",
        does="publishes a topic as one of several, which services select",
        is_light=True,
    ),
)
