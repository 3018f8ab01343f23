"""What a plug-in gets when it is loaded, and what it leaves behind when it is closed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Protocol

from gazelle.description.model import CameraSpec, Model, PluginTag, Sensor
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.graph import Qos
from gazelle.graph.subscription import MAX_WAITING, Backlog
from gazelle.interfaces import message_type, service_type
from gazelle.simulator.command_queue import CommandQueue
from gazelle.simulator.input_validation import InputRefusedError, Inputs, problem_of, refusal
from gazelle.simulator.node_interfaces import NodePort, PublisherPort
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.scheduler import (
    ORDER_CONTROL,
    Scheduler,
    Task,
    gz_sensor_period_in_steps,
    measured_period_in_steps,
    period_in_steps,
    throttled_period_in_steps,
)

if TYPE_CHECKING:
    from gazelle.engine import Engine
    from gazelle.simulator.render_thread import FrameWorker
    from gazelle.simulator.sensor_set import SensorSet
    from gazelle.simulator.world_controller_managers import ControlRegistry
    from gazelle.workspace import Workspace

_DEPTH = 10
_SENSOR_DEPTH = 5
_ROS2 = 2
# Kinds besides cameras that Gazebo renders.
_RENDERED = frozenset({"gpu_ray", "gpu_lidar"})

__all__ = ["Host", "PluginContext", "Resources", "SensorPlace", "join_names"]


class Host(Protocol):
    """The world server as plug-ins see it."""

    engine: Engine
    node: NodePort
    scheduler: Scheduler
    commands: CommandQueue
    inputs: Inputs
    controls: ControlRegistry
    diagnostics: Diagnostics
    sensors: SensorSet
    frames: FrameWorker
    workspace: Workspace | None
    seed: int

    @property
    def lockstep(self) -> bool:
        """True when every camera frame is finished before time goes on."""
        ...

    @property
    def time_ns(self) -> int:
        """Simulated time."""
        ...

    @property
    def ros_version(self) -> int:
        """The version of ROS that started the simulator, 0 when nothing tells."""
        ...


@dataclass(frozen=True, slots=True)
class SensorPlace:
    """A sensor and the link it sits on.

    Attributes:
        name: ``model::link::sensor``, of a joint's sensor ``model::joint::sensor``.
        link_name: ``model::link``; the joint's child for the sensor of a joint.
        joint_name: ``model::joint``, empty for a sensor on a link.
        is_gz: gz-sim's own systems publish it, not a plug-in of Gazebo Classic.
    """

    name: str
    link_name: str
    sensor: Sensor
    joint_name: str = ""
    is_gz: bool = False

    def period_in_steps(self, step_ns: int, largest_rate_hz: float = 0.0) -> Fraction:
        """Return the sensor's period, or that of whoever skips its readings above a rate."""
        rate_hz = self.sensor.update_rate_hz
        if self.is_gz:
            return gz_sensor_period_in_steps(rate_hz, step_ns)
        is_rendered = isinstance(self.sensor.spec, CameraSpec) or self.sensor.type in _RENDERED
        period_of = period_in_steps if is_rendered else measured_period_in_steps
        return throttled_period_in_steps(period_of(rate_hz, step_ns), largest_rate_hz, step_ns)


class Resources:
    """Publishers, subscriptions, services and tasks of one model; released together."""

    def __init__(self, host: Host) -> None:
        self._host = host
        self._closers: list[Callable[[], None]] = []
        self._reset_actions: list[Callable[[], None]] = []
        self._calm_actions: list[Callable[[str], None]] = []

    def publisher(
        self, topic: str, type_name: str, *, latch: bool = False, reliable: bool = True
    ) -> PublisherPort:
        """Offer a topic; in lock-step all are reliable, so that every run is heard the same."""
        # gazebo_ros offers sensors as SensorDataQoS().reliable(); here they wait for nobody.
        made = self._host.node.create_publisher(
            topic,
            message_type(type_name),
            latch=latch,
            reliable=reliable or self._host.lockstep,
            qos=Qos(latched=latch, depth=_DEPTH if reliable else _SENSOR_DEPTH),
        )
        self._closers.append(made.unregister)
        return made

    def subscription(
        self,
        topic: str,
        type_name: str | None,
        callback: Callable[[Any], None],
        *,
        announced: str = "",
        takes_any_number: bool = False,
    ) -> None:
        """Listen; `callback` runs between two steps, in the thread that owns the world.

        Args:
            topic: where.
            type_name: None takes messages of any type.
            callback: takes a message; one whose numbers cannot be is told once and left out.
            announced: the type that others see where any is taken.
            takes_any_number: `callback` knows itself what NaN and the like mean to it.
        """
        host, told = self._host, set[str]()

        def overflowed() -> None:
            text = f"more than {MAX_WAITING} messages wait for the world; the oldest are left out"
            host.node.log("WARN", f"[{topic}] {text}")

        backlog = Backlog(host.commands.post, callback, overflowed)

        def queue(message: Any) -> None:
            problem = "" if takes_any_number else problem_of(message)
            if not problem:
                host.inputs.note(topic, host.time_ns)
                backlog.put(message)
            elif (field := problem.partition(" is ")[0]) not in told:
                told.add(field)
                names = host.node.publisher_names(topic)
                by = f" (published by {', '.join(names)})" if names else ""
                host.node.log("WARN", f"[{topic}] {problem}; the message is left out{by}")

        wanted = None if type_name is None else message_type(type_name)
        made = self._host.node.create_subscription(
            topic, wanted, queue, inline=True, announced=announced
        )
        self._closers.append(made.unregister)
        self._closers.append(lambda: host.inputs.forget(topic))

    def service(
        self,
        name: str,
        type_name: str,
        handler: Callable[[Any, Any], None],
        *,
        takes_any_number: bool = False,
    ) -> None:
        """Answer a service; `handler(request, response)` fills the response between two steps.

        A request whose numbers cannot be has no effect, nor has one that `handler` refuses with
        `InputRefusedError`; the answer says so, and the log whose it was.
        """
        host, service = self._host, service_type(type_name)

        def answer(request: Any, caller: str) -> Any:
            response = service.Response()
            try:
                if not takes_any_number and (problem := problem_of(request)):
                    raise InputRefusedError(problem)
                host.inputs.note(name, host.time_ns, caller)
                host.commands.call(lambda: handler(request, response))
            except InputRefusedError as refused:
                by = f" (called by {caller})" if caller else ""
                text = f"{name}: {refused}; nothing is changed{by}"
                host.node.log("WARN", text)
                return refusal(response, text)
            return response

        made = host.node.create_service(name, service, answer, with_caller=True)
        self._closers.append(made.unregister)
        self._closers.append(lambda: host.inputs.forget(name))

    def task(
        self,
        name: str,
        period_steps: Fraction,
        action: Callable[[], None],
        *,
        order: int = ORDER_CONTROL,
        wanted: Callable[[], bool] | None = None,
    ) -> Task:
        """Have something done every so many steps."""
        task = self._host.scheduler.add(Task(name, period_steps, action, order, wanted))
        self._closers.append(lambda: self._host.scheduler.remove(task))
        return task

    def on_reset(self, action: Callable[[], None]) -> None:
        """Have something done after the world was reset."""
        self._reset_actions.append(action)

    def on_calm(self, action: Callable[[str], None]) -> None:
        """Have something done with the name of a model that diverged and was brought to rest.

        Whoever commands its joints on and on ends that: what threw it once does so again.
        """
        self._calm_actions.append(action)

    def on_close(self, action: Callable[[], None]) -> None:
        """Have something done when the model goes."""
        self._closers.append(action)

    def reset(self) -> None:
        """Run the reset actions."""
        for action in self._reset_actions:
            action()

    def calm(self, model: str) -> None:
        """Run the actions for a model that was brought to rest."""
        for action in self._calm_actions:
            action(model)

    def close(self) -> None:
        """Release everything, last first; closing twice does nothing."""
        while self._closers:
            self._closers.pop()()
        self._reset_actions.clear()
        self._calm_actions.clear()


@dataclass(frozen=True, slots=True)
class PluginContext:
    """One plug-in about to be loaded.

    Attributes:
        model: the model in the world, under its name there; an empty one for a world plug-in.
        place: the sensor it stands in, None for a model plug-in.
        default_namespace: namespace for plug-ins that name none (``-robot_namespace``).
    """

    host: Host
    model: Model
    plugin: PluginTag
    resources: Resources
    place: SensorPlace | None = None
    default_namespace: str = ""

    @property
    def is_of_world(self) -> bool:
        """Whether it is a plug-in of the world, whose `model` is a stand-in."""
        return all(self.model is not model for model in self.host.engine.world.models)

    @property
    def owner(self) -> str:
        """Whose plug-in it is, in words: ``model 'm'`` or ``world 'w'``."""
        return f"{'world' if self.is_of_world else 'model'} '{self.model.name}'"

    def reader(self, table: PluginTable) -> PluginReader:
        """Return the reader of this plug-in's keys."""
        host = self.host
        return PluginReader(self.plugin, table, host.diagnostics, host.ros_version)

    def report(
        self,
        code: str,
        message: str,
        *,
        fix: str = "",
        about: str = "",
        at: SourceSpan | None = None,
    ) -> None:
        """Report something about this plug-in.

        Args:
            code: of the catalogue.
            message: what is wrong.
            fix: what to do.
            about: a value that is wrong; its element is the place, else the plug-in's.
            at: another file that is to blame; the plug-in's element leads there.
        """
        tags = self.plugin.parameters.walk() if about else iter(())
        span = next((tag.span for tag in tags if about in tag.text.split()), self.plugin.span)
        if at is not None:
            span = replace(at, via=(span, *span.via) if span is not None else ())
        self.host.diagnostics.report(code, message, span, fix=fix)

    def namespace(self, parameters: PluginReader) -> str:
        """Return the namespace of the plug-in's topics, absolute.

        What a robot is spawned into goes before ``<ros>``'s namespace, as ROS 2's factory writes
        it there, and behind ``<robotNamespace>``.
        """
        own, given = parameters.ros.namespace, self.default_namespace
        if parameters.is_ros2() or not parameters.knows("robotNamespace"):
            if self.host.ros_version != _ROS2:
                # ROS 1's spawner sends its own namespace where none is asked for.
                given = given.strip("/")
            return join_names("/", given or own)
        name = parameters.text("robotNamespace", self.default_namespace)
        return join_names("/", name)

    def topic(self, parameters: PluginReader, name: str, *within: str) -> str:
        """Return the absolute name of a topic of this plug-in.

        ROS 2 remappings of the ``<ros>`` block apply; ``~/x`` is below the plug-in's name.
        """
        namespace = join_names(self.namespace(parameters), *within)
        wanted = parameters.ros.remapped(name)
        if wanted.startswith("~/"):
            return join_names(namespace, self.plugin.name, wanted[2:])
        return join_names(namespace, wanted)

    def joint_name(self, name: str) -> str | None:
        """Return ``model::joint``; reports a joint that is not there and returns None."""
        names = [joint.name for joint in self.model.joints]
        if name in names:
            return f"{self.model.name}::{name}"
        text = f"plug-in '{self.plugin.name}' needs joint '{name}', which {self.owner} does not "
        text += "have; the plug-in is left out"
        self.report("plugin.missing-joint", text, fix=did_you_mean(name, names), about=name)
        return None

    def link_name(self, name: str) -> str | None:
        """Return ``model::link``; reports a link that is not there and returns None."""
        names = [link.name for link in self.model.links]
        wanted = name.removeprefix(f"{self.model.name}::")
        if wanted in names:
            return f"{self.model.name}::{wanted}"
        text = f"plug-in '{self.plugin.name}' needs link '{name}', which {self.owner} does not "
        text += "have; the plug-in is left out"
        self.report("plugin.missing-link", text, fix=did_you_mean(name, names), about=name)
        return None

    def tf_prefix(self, namespace: str) -> str:
        """Return the ``tf_prefix`` parameter of a namespace, empty when there is none."""
        name = join_names(namespace, "tf_prefix")
        return str(self.host.node.parameters.get(name, ""))


def join_names(namespace: str, *names: str) -> str:
    """Join ROS names; an absolute one starts anew, doubled slashes collapse."""
    result = namespace
    for name in names:
        result = name if name.startswith("/") else f"{result}/{name}"
    return "/" + "/".join(word for word in result.split("/") if word)
