"""The gz-sim system ``VelocityControl``: a model or link that moves as it is told."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from gazelle.geometry import Pose, Vector3
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.plugin_parameters import PluginTable

__all__ = ["TABLE", "load"]

Setter = Callable[[Vector3, Vector3], None]

TABLE = PluginTable(
    ParameterTable(
        "gz-sim velocity control",
        "Sets the velocity of a model, or of single links, at every step.",
        (
            "gz-sim-velocity-control-system",
            "ignition-gazebo-velocity-control-system",
            "gz::sim::systems::VelocityControl",
            "ignition::gazebo::systems::VelocityControl",
        ),
        (
            Parameter("topic", "text", "/model/{model}/cmd_vel", "commands of the model"),
            Parameter("initial_linear", "vector", (0.0, 0.0, 0.0), "speed at the start", "m/s"),
            Parameter(
                "initial_angular", "vector", (0.0, 0.0, 0.0), "turn rate at the start", "rad/s"
            ),
            Parameter("link_name", "text", "", "a link that is commanded by itself, repeatable"),
        ),
    ),
    topics=(
        Topic("{topic}", "geometry_msgs/msg/Twist", kind="listens"),
        Topic("/model/M/link/{link_name}/cmd_vel", "geometry_msgs/msg/Twist", kind="listens"),
    ),
    behaviour=(
        "Velocities are in the frame of the model or link and are set at every step, so gravity"
        " and friction act within a step only.",
        "Topics keep their gz names and carry the ROS types that `ros_gz_bridge` maps them to.",
    ),
)


def load(context: PluginContext) -> None:
    """Start moving the model and the named links."""
    parameters = context.reader(TABLE)
    engine, model = context.host.engine, context.model
    topic = parameters.text("topic").replace("{model}", model.name)
    initial = (parameters.vector("initial_linear"), parameters.vector("initial_angular"))
    _Mover(
        context,
        join_names("/", topic),
        lambda: engine.model_pose(model.name),
        lambda linear, angular: engine.set_model_velocity(model.name, linear, angular),
        initial,
    )
    for name in parameters.texts("link_name"):
        full = context.link_name(name)
        if full is not None:
            link = engine.link(full)
            topic = f"/model/{model.name}/link/{name}/cmd_vel"
            _Mover(context, topic, link.T_world_link, link.set_velocity, None)
    parameters.report_unread()


class _Mover:
    """Moves one thing as its topic says."""

    def __init__(
        self,
        context: PluginContext,
        topic: str,
        pose: Callable[[], Pose],
        set_velocity: Setter,
        initial: tuple[Vector3, Vector3] | None,
    ) -> None:
        self._pose, self._set, self._initial = pose, set_velocity, initial
        self._command = initial
        resources = context.resources
        # Twist and TwistStamped are both taken.
        resources.subscription(topic, None, self._take, announced="geometry_msgs/msg/Twist")
        resources.task(f"{context.plugin.name} {topic}", Fraction(1), self._move)
        resources.on_reset(self._reset)

    def _take(self, message: Any) -> None:
        twist = getattr(message, "twist", message)
        linear, angular = twist.linear, twist.angular
        self._command = (
            (float(linear.x), float(linear.y), float(linear.z)),
            (float(angular.x), float(angular.y), float(angular.z)),
        )

    def _move(self) -> None:
        if self._command is not None:
            pose = self._pose()
            self._set(pose.rotate(self._command[0]), pose.rotate(self._command[1]))

    def _reset(self) -> None:
        self._command = self._initial
