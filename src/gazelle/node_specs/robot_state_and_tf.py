"""Robot descriptions, joint states and transforms."""

from __future__ import annotations

from gazelle.node_specs.spec import ROS_1, NodeName, NodeRole, NodeSpec, listens, publishes

__all__ = ["TRANSFORMS"]

TRANSFORMS = (
    NodeSpec(
        package="joint_state_publisher",
        executable="joint_state_publisher",
        entry="gazelle.studio.windows.gui_nodes:joint_state_publisher",
        does="publishes joint states of a robot description, with sliders if use_gui is true",
        is_light=True,
        parameters="gazelle.nodes.joint_state_publisher:PARAMETERS",
        role=NodeRole.JOINT_STATES,
        topics=(
            publishes("joint_states", "sensor_msgs/msg/JointState"),
            listens("joint_states", "sensor_msgs/msg/JointState"),
        ),
    ),
    NodeSpec(
        package="robot_state_publisher",
        executable="robot_state_publisher",
        entry="gazelle.nodes.robot_state_publisher:run",
        does="turns joint states into tf",
        is_light=True,
        parameters="gazelle.nodes.robot_state_publisher:PARAMETERS",
        aliases=(NodeName("robot_state_publisher", "state_publisher", ROS_1),),
        role=NodeRole.STATE_PUBLISHER,
        topics=(
            publishes("/tf", "tf2_msgs/msg/TFMessage"),
            publishes("/tf_static", "tf2_msgs/msg/TFMessage"),
            listens("joint_states", "sensor_msgs/msg/JointState"),
        ),
        is_complete=True,
    ),
    NodeSpec(
        package="tf",
        executable="tf_remap",
        ros=ROS_1,
        entry="gazelle.nodes.tf_remap:run",
        does="publishes transforms with other names of frames",
        is_light=True,
        parameters="gazelle.nodes.tf_remap:PARAMETERS",
        name="tf_remapper",
        topics=(
            publishes("/tf", "tf2_msgs/msg/TFMessage"),
            listens("/tf_old", "tf2_msgs/msg/TFMessage"),
        ),
        frames=None,
    ),
    NodeSpec(
        package="tf",
        executable="static_transform_publisher",
        ros=ROS_1,
        entry="gazelle.nodes.static_transform_publisher:run_tf",
        does="publishes one fixed transform again and again",
        is_light=True,
        role=NodeRole.STATIC_TRANSFORM,
        topics=(publishes("/tf", "tf2_msgs/msg/TFMessage"),),
        is_complete=True,
    ),
    NodeSpec(
        package="tf2_ros",
        executable="static_transform_publisher",
        entry="gazelle.nodes.static_transform_publisher:run_tf2",
        does="publishes one fixed transform, latched",
        is_light=True,
        parameters="gazelle.nodes.static_transform_publisher:PARAMETERS",
        role=NodeRole.STATIC_TRANSFORM,
        topics=(publishes("/tf_static", "tf2_msgs/msg/TFMessage"),),
        is_complete=True,
    ),
    NodeSpec(
        package="joint_state_publisher_gui",
        executable="joint_state_publisher_gui",
        entry="gazelle.studio.windows.gui_nodes:joint_state_publisher_gui",
        does="publishes joint states, moved by sliders",
        is_light=False,
        parameters="gazelle.nodes.joint_state_publisher:PARAMETERS",
        role=NodeRole.JOINT_STATES,
        topics=(
            publishes("joint_states", "sensor_msgs/msg/JointState"),
            listens("joint_states", "sensor_msgs/msg/JointState"),
        ),
    ),
)
