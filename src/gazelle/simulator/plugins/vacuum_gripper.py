"""``libgazebo_ros_vacuum_gripper``: what comes near its link hangs on it, ROS 1 and 2."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from gazelle.interfaces import message_type
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["TABLE", "load"]

# How often a gripper that is on looks for things; Gazebo looks at every step.
_LOOK_HZ = 100.0

TABLE = PluginTable(
    ParameterTable(
        "vacuum_gripper",
        "Holds links of other models that come near the gripper's link, while it is on.",
        ("gazebo_ros_vacuum_gripper",),
        (
            Parameter(
                "robotNamespace", "text", "", "namespace of topic and services", ros_versions=(1,)
            ),
            Parameter("bodyName", "text", "", "the link that holds", "", aliases=("link_name",)),
            Parameter(
                "topicName", "text", "grasping", "whether something is held", ros_versions=(1,)
            ),
            Parameter("max_distance", "number", 0.05, "reach (ROS 2)", "m", ros_versions=(2,)),
            Parameter(
                "fixed",
                "text",
                "",
                "a model or link that is never held, repeatable (ROS 2)",
                ros_versions=(2,),
            ),
        ),
    ),
    topics=(Topic("{topicName}", "std_msgs/msg/Bool", rate="every step", ros2="grasping"),),
    services=(
        Topic("on, off (ROS 1)", "std_srvs/srv/Empty", kind="service"),
        Topic("switch (ROS 2)", "std_srvs/srv/SetBool", kind="service"),
    ),
    behaviour=(
        "A link is near when its origin is within `max_distance` of the gripper's origin. It is"
        " held by a weld at the pose it has then, until the gripper is switched off; Gazebo pulls"
        " it with up to 20 N (ROS 1) or 1 N (ROS 2) and copies the gripper's speed.",
        "Static models are never held; `fixed` exempts others.",
        "`grasping` is sent at every step to those who listen.",
    ),
    in_both_ros=True,
)


def load(context: PluginContext) -> None:
    """Start a gripper, switched off; nothing else when the link is missing."""
    parameters = context.reader(TABLE)
    name = context.link_name(parameters.text("bodyName"))
    if name is not None:
        _Gripper(context, parameters, name)
    parameters.report_unread()


class _Gripper:
    """One running gripper."""

    def __init__(self, context: PluginContext, parameters: PluginReader, link: str) -> None:
        self._context = context
        self._engine = context.host.engine
        self._link = self._engine.link(link)
        self._reach_m = parameters.number("max_distance")
        self._exempt = frozenset(parameters.texts("fixed")) | {context.model.name}
        self._is_on = False
        self._held: list[str] = []
        self._offer(parameters)

    def _offer(self, parameters: PluginReader) -> None:
        context, resources = self._context, self._context.resources
        name = context.plugin.name
        ros2 = parameters.is_ros2("max_distance")
        topic = context.topic(parameters, parameters.text("topicName"))
        self._publisher = resources.publisher(topic, "std_msgs/Bool")
        if ros2:
            switch = context.topic(parameters, "switch")
            resources.service(switch, "std_srvs/SetBool", self._switch)
        else:
            for word, answer in (("on", self._on), ("off", self._off)):
                service = join_names(context.namespace(parameters), word)
                resources.service(service, "std_srvs/Empty", answer)
        looks = period_in_steps(_LOOK_HZ, self._engine.step_ns)
        resources.task(f"{name} look", looks, self._look, wanted=lambda: self._is_on)
        resources.task(
            f"{name} status", Fraction(1), self._publish, wanted=lambda: self._publisher.matched
        )
        resources.on_reset(self._reset)
        resources.on_close(lambda: self._turn(False))

    def _switch(self, request: Any, response: Any) -> None:
        response.success = bool(request.data) != self._is_on
        self._turn(bool(request.data))

    def _on(self, _request: Any, _response: Any) -> None:
        self._turn(True)

    def _off(self, _request: Any, _response: Any) -> None:
        self._turn(False)

    def _turn(self, on: bool) -> None:
        self._is_on = on
        if on:
            self._look()
            return
        for name in self._held:
            self._engine.detach(self._link.name, name)
        self._held.clear()

    def _look(self) -> None:
        present = set(self._engine.link_names)
        self._held = [name for name in self._held if name in present]
        place = self._link.T_world_link().position_m
        for model in self._engine.world.models:
            if model.static or model.name in self._exempt:
                continue
            for link in model.links:
                name = f"{model.name}::{link.name}"
                near = math.dist(self._engine.link(name).T_world_link().position_m, place)
                if near <= self._reach_m and name not in self._held and not self._spares(name):
                    self._engine.attach(self._link.name, name)
                    self._held.append(name)

    def _spares(self, link: str) -> bool:
        return link in self._exempt or link.partition("::")[2] in self._exempt

    def _publish(self) -> None:
        self._publisher.publish(message_type("std_msgs/Bool")(data=bool(self._held)))

    def _reset(self) -> None:
        # The engine's reset has let everything go.
        self._is_on = False
        self._held.clear()
