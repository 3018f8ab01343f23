"""``libgazebo_ros_joint_state_publisher`` and the gz-sim system of the same purpose."""

from __future__ import annotations

import re

import numpy as np

from gazelle.description.model import JointType
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.plugin_parameters import PluginTable
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["GZ_TABLE", "TABLE", "load", "load_gz"]

TABLE = PluginTable(
    ParameterTable(
        "joint_state_publisher",
        "Publishes the positions and velocities of joints.",
        ("gazebo_ros_joint_state_publisher",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic", ros_versions=(1,)),
            Parameter(
                "jointName",
                "text",
                "",
                "joints, separated by commas or repeated; all joints when empty",
                "",
                aliases=("joint_name",),
            ),
            Parameter(
                "updateRate", "number", 100.0, "publish rate", "Hz", aliases=("update_rate",)
            ),
            Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
        ),
    ),
    topics=(
        Topic("joint_states", "sensor_msgs/msg/JointState", rate="`updateRate`", frame="none"),
    ),
    behaviour=("The effort field stays empty, as in the ROS 1 plug-in.",),
    in_both_ros=True,
)

GZ_TABLE = PluginTable(
    ParameterTable(
        "gz-sim joint_state_publisher",
        "The gz-sim system: all joints of the model at every step, as ROS joint states.",
        (
            "gz-sim-joint-state-publisher-system",
            "ignition-gazebo-joint-state-publisher-system",
            "gz::sim::systems::JointStatePublisher",
            "ignition::gazebo::systems::JointStatePublisher",
        ),
        (
            Parameter("topic", "text", "/world/{world}/model/{model}/joint_state", "topic"),
            Parameter("joint_name", "text", "", "joints, repeatable; all joints when absent"),
            Parameter("update_rate", "number", 0.0, "publish rate, 0 for every step", "Hz"),
        ),
    ),
    topics=(Topic("{topic}", "sensor_msgs/msg/JointState", rate="every step", frame="none"),),
)


def load(context: PluginContext) -> None:
    """Start the publisher of ROS 1 or ROS 2."""
    parameters = context.reader(TABLE)
    joint_names = [
        word for text in parameters.texts("jointName") for word in re.split(r"[,\s]+", text)
    ]
    topic = join_names(context.namespace(parameters), parameters.ros.remapped("joint_states"))
    _start(context, topic, [word for word in joint_names if word], parameters.number("updateRate"))
    parameters.report_unread()


def load_gz(context: PluginContext) -> None:
    """Start the gz-sim publisher."""
    parameters = context.reader(GZ_TABLE)
    topic = parameters.text("topic").replace("{world}", context.host.engine.world.name)
    topic = join_names("/", topic.replace("{model}", context.model.name))
    joint_names = list(parameters.texts("joint_name"))
    _start(context, topic, joint_names, parameters.number("update_rate"))
    parameters.report_unread()


def _start(context: PluginContext, topic: str, wanted: list[str], rate_hz: float) -> None:
    engine = context.host.engine
    moving = [joint.name for joint in context.model.joints if joint.type is not JointType.FIXED]
    found = [context.joint_name(name) for name in wanted or moving]
    joints = [engine.joint(name) for name in found if name is not None]
    names = [joint.name.split("::", 1)[1] for joint in joints]
    publisher = context.resources.publisher(topic, "sensor_msgs/JointState")

    def publish() -> None:
        message = message_type("sensor_msgs/JointState")(
            header=header(engine.time_ns, ""),
            name=list(names),
            position=np.array([joint.position for joint in joints]),
            velocity=np.array([joint.velocity for joint in joints]),
        )
        publisher.publish(message)

    period = period_in_steps(rate_hz, engine.step_ns)
    task = f"{context.plugin.name} joint states"
    context.resources.task(task, period, publish, wanted=lambda: publisher.matched)
