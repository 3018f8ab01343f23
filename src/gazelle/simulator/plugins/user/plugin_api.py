"""What a plug-in of the user's own derives from, and what it is given: world, parameters, node."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from gazelle.description.model import World
from gazelle.description.xml import Tag
from gazelle.description.xml.numbers import bool_from, float_from, floats_from
from gazelle.diagnostics import nearest_names
from gazelle.errors import GazelleError, NotFoundError
from gazelle.interfaces import message_type
from gazelle.parameters import Parameter, ParameterTable
from gazelle.simulator.node_interfaces import PublisherPort
from gazelle.simulator.plugins.context import Host, PluginContext, Resources
from gazelle.simulator.plugins.plugin_parameters import PluginTable
from gazelle.simulator.simulation_handles import SimModel

if TYPE_CHECKING:
    from gazelle.simulator.simulation_handles import SimModel, SimSensor

__all__ = [
    "ModelPlugin",
    "Plugin",
    "PluginNode",
    "PluginParameters",
    "SensorPlugin",
    "WorldOfPlugin",
    "WorldPlugin",
]


class Plugin:
    """Hooks that every plug-in may have; those it does not write cost nothing.

    Attributes:
        update_rate_hz: how often `on_update` is called; None for every step, and for the rate of
            the sensor that a sensor plug-in stands in.
    """

    update_rate_hz: ClassVar[float | None] = None

    def on_update(self, time_s: float) -> None:
        """Called between two steps, at simulated time."""

    def on_reset(self) -> None:
        """Called after the world was put back to its start."""

    def close(self) -> None:
        """Called when the model goes or the world ends; topics are closed without it."""


class WorldPlugin(Plugin):
    """A ``<plugin>`` that stands in a ``<world>``."""

    def load(self, world: WorldOfPlugin, parameters: PluginParameters, node: PluginNode) -> None:
        """Called once, before the first step."""


class ModelPlugin(Plugin):
    """A ``<plugin>`` that stands in a ``<model>``, or in a ``<gazebo>`` of a URDF."""

    def load(self, model: SimModel, parameters: PluginParameters, node: PluginNode) -> None:
        """Called once, when the model enters the world."""


class SensorPlugin(Plugin):
    """A ``<plugin>`` that stands in a ``<sensor>``."""

    def load(self, sensor: SimSensor, parameters: PluginParameters, node: PluginNode) -> None:
        """Called once, when the sensor's model enters the world."""


_TABLE = PluginTable(
    ParameterTable(
        "user",
        "",
        (),
        (Parameter("robotNamespace", "text", "", "namespace of the topics"),),
    ),
)

Guard = Callable[[Callable[[], Any]], Any]


class PluginParameters(Mapping[str, str]):
    """The elements inside ``<plugin>``: texts by name, the first of each.

    Attributes:
        tag: the element itself, with attributes, repeated and nested elements.
    """

    def __init__(self, context: PluginContext) -> None:
        """Read the plug-in's element."""
        self.tag: Tag = context.plugin.parameters
        self._diagnostics = context.host.diagnostics

    def __getitem__(self, key: str) -> str:
        """Return the text of an element."""
        found = self.tag.find(key)
        if found is None:
            raise KeyError(key)
        return found.text

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names of the elements."""
        return iter(dict.fromkeys(child.name for child in self.tag.children))

    def __len__(self) -> int:
        """Return how many names there are."""
        return len({child.name for child in self.tag.children})

    def number(self, key: str, default: float = 0.0) -> float:
        """Return a number; a text that is none is reported and `default` returned."""
        return float_from(self.tag.find(key), default, self._diagnostics)

    def flag(self, key: str, default: bool = False) -> bool:
        """Return a truth value."""
        return bool_from(self.tag.find(key), default, self._diagnostics)

    def vector(
        self, key: str, default: tuple[float, float, float] = (0.0, 0.0, 0.0)
    ) -> tuple[float, float, float]:
        """Return three numbers."""
        tag = self.tag.find(key)
        if tag is None or not tag.text:
            return default
        x, y, z = floats_from(
            tag.text, 3, default, what=f"<{key}>", span=tag.span, diagnostics=self._diagnostics
        )
        return (x, y, z)


class WorldOfPlugin:
    """The world."""

    def __init__(self, host: Host) -> None:
        """Look at the world of a server."""
        self._host = host

    @property
    def name(self) -> str:
        """Its name."""
        return self.description.name

    @property
    def description(self) -> World:
        """Everything that is in it now."""
        return self._host.engine.world

    @property
    def time_s(self) -> float:
        """Simulated time."""
        return self._host.engine.time_ns * 1e-9

    @property
    def models(self) -> tuple[str, ...]:
        """Names of the models."""
        return tuple(model.name for model in self.description.models)

    def model(self, name: str) -> SimModel:
        """Return a model.

        Raises:
            NotFoundError: there is none; the message names the nearest.
        """
        if name not in self.models:
            raise NotFoundError("model", name, nearest=nearest_names(name, self.models))
        return SimModel(self._host, name)


class PluginNode:
    """Topics, services and log of a plug-in.

    Relative names lie in the namespace that ``<robotNamespace>`` or ``<ros><namespace>`` gives,
    ``~/`` below the plug-in's name; remappings of ``<ros>`` apply. Callbacks run between two
    steps.
    """

    def __init__(self, context: PluginContext, resources: Resources, guard: Guard) -> None:
        """Offer what the server has.

        Args:
            context: of the plug-in.
            resources: keep what the plug-in opens.
            guard: runs the plug-in's code.
        """
        self._context = context
        self._resources = resources
        self._guard = guard
        self._reader = context.reader(_TABLE)
        self._publishers: dict[str, PublisherPort] = {}

    @property
    def name(self) -> str:
        """Name of the plug-in."""
        return self._context.plugin.name

    def message(self, type_name: str, **fields: Any) -> Any:
        """Return a message of a type such as ``std_msgs/Float64``."""
        return message_type(type_name)(**fields)

    def advertise(self, topic: str, message_type: Any, *, latch: bool = False) -> PublisherPort:
        """Offer a topic; its ``matched`` tells whether anybody listens."""
        made = self._publishers.get(topic)
        if made is None:
            name = _type_name(message_type)
            made = self._resources.publisher(self._topic(topic), name, latch=latch)
            self._publishers[topic] = made
        return made

    def publish(self, topic: str, message: Any) -> None:
        """Send a message; the topic is offered with the first one."""
        self.advertise(topic, type(message)).publish(message)

    def subscribe(self, topic: str, message_type: Any, callback: Callable[[Any], None]) -> None:
        """Listen to a topic."""

        def take(message: Any) -> None:
            self._guard(lambda: callback(message))

        name = self._topic(topic)
        wanted = _type_name(message_type)
        self._resources.subscription(name, wanted, take, takes_any_number=True)

    def service(self, name: str, service_type: str, handler: Callable[[Any, Any], None]) -> None:
        """Answer a service; `handler(request, response)` fills the response."""

        def answer(request: Any, response: Any) -> None:
            self._guard(lambda: handler(request, response))

        self._resources.service(self._topic(name), service_type, answer, takes_any_number=True)

    def get_param(self, name: str, default: Any = None) -> Any:
        """Return a parameter of the ROS 1 store."""
        return self._context.host.node.parameters.get(self._topic(name), default)

    def log_debug(self, text: str) -> None:
        """Log a detail."""
        self._context.host.node.log("DEBUG", text)

    def log_info(self, text: str) -> None:
        """Log what goes on."""
        self._context.host.node.log("INFO", text)

    def log_warn(self, text: str) -> None:
        """Log a warning."""
        self._context.host.node.log("WARN", text)

    def log_error(self, text: str) -> None:
        """Log an error."""
        self._context.host.node.log("ERROR", text)

    def _topic(self, name: str) -> str:
        return self._context.topic(self._reader, name)


def _type_name(message_type: Any) -> str:
    if isinstance(message_type, str):
        return message_type
    name = getattr(message_type, "TYPE_NAME", "") or getattr(message_type, "_type", "")
    if not name:
        raise GazelleError(f"{message_type!r} is not a message type")
    return str(name).replace("/msg/", "/")
