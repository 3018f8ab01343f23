"""Parameters of the turtles: ROS 1's store, or those of a ROS 2 node.

A new background counts from the next ``clear`` (ROS 1) or at once (ROS 2).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Protocol

from gazelle.errors import LaunchError
from gazelle.graph import Node
from gazelle.graph.ros2_node_parameters import Descriptor
from gazelle.graph.ros2_parameter_values import parameter_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import node_parameters
from gazelle.nodes.turtlesim.canvas import BACKGROUND
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "Settings", "settings_of"]

Color = tuple[int, int, int]

_CHANNELS = ("background_r", "background_g", "background_b")
_DEFAULTS = dict(zip(_CHANNELS, BACKGROUND, strict=True))
_WORDS = dict(zip(_CHANNELS, ("Red", "Green", "Blue"), strict=True))
_MAX = 255

PARAMETERS = ParameterTable(
    "turtlesim",
    "Turtles that draw. In ROS 2 a value that does not fit ends it.",
    ("turtlesim/turtlesim_node",),
    (
        *(
            Parameter(
                name,
                "integer",
                _DEFAULTS[name],
                f"{word.lower()} of the colour below the lines; in ROS 1 from the next `clear`, and"
                f" `{name}` of the namespace counts, too, as up to Melodic",
                low=0,
                high=_MAX,
                live=True,
            )
            for name, word in _WORDS.items()
        ),
        Parameter(
            "holonomic",
            "flag",
            False,
            "turtles go sideways, too, as they always do in ROS 1",
            ros_versions=(2,),
            live=True,
        ),
        Parameter(
            "png", "text", "", "file for the picture, at the end and by `~save_image`, as `--png`"
        ),
    ),
)


class Settings(Protocol):
    """What the turtles want to know."""

    def background(self) -> Color:
        """Return the colour below the lines."""
        ...

    def is_holonomic(self) -> bool:
        """Tell whether turtles go sideways too."""
        ...


def settings_of(
    node: Node, arguments: NodeArguments, on_background: Callable[[Color], None]
) -> Settings:
    """Declare the parameters.

    Args:
        node: the simulator's.
        arguments: its command line.
        on_background: hears of each new background at once (ROS 2).

    Raises:
        LaunchError: a value of the command line does not fit (ROS 2).
    """
    if arguments.ros_version == 2:
        return _Ros2Settings(node, arguments, on_background)
    return _Ros1Settings(node)


class _Ros1Settings:
    def __init__(self, node: Node) -> None:
        self._node = node
        for name, value in _DEFAULTS.items():
            if not node.parameters.has(f"~{name}"):
                node.parameters.set(f"~{name}", value)

    def background(self) -> Color:
        return _color({name: self._channel(name, value) for name, value in _DEFAULTS.items()})

    def is_holonomic(self) -> bool:
        return True

    def _channel(self, name: str, default: int) -> int:
        """Return the node's own value, or the older global one when that one was never set."""
        store = self._node.parameters
        own = store.get(f"~{name}") if store.has(f"~{name}") else default
        value = store.get(name) if own == default and store.has(name) else own
        if isinstance(value, int) and 0 <= value <= _MAX:
            return int(value)
        text = f"parameter '{name}' is {value!r}, no whole number from 0 to {_MAX}"
        self._node.log("warn", f"{text}; {default} is taken")
        return default


class _Ros2Settings:
    def __init__(
        self, node: Node, arguments: NodeArguments, on_background: Callable[[Color], None]
    ) -> None:
        values: dict[str, Any] = {**_DEFAULTS, "holonomic": False, "use_sim_time": False}
        for name in values.keys() & arguments.params.keys():
            values[name] = _declared(name, arguments.params[name], values[name])
        descriptors = {
            name: Descriptor(f"{word} channel of the background color", lowest=0, highest=_MAX)
            for name, word in _WORDS.items()
        }
        descriptors["holonomic"] = Descriptor("If true, then turtles will be holonomic")
        self._node = node
        self._on_background = on_background
        self._values = dict(values)
        self._use_sim_time(values)
        node_parameters(node, values, self._on_set, descriptors=descriptors)

    def background(self) -> Color:
        return _color(self._values)

    def is_holonomic(self) -> bool:
        return bool(self._values["holonomic"])

    def _on_set(self, changes: Mapping[str, Any]) -> str:
        self._use_sim_time(changes)
        self._values.update(changes)
        if not _DEFAULTS.keys().isdisjoint(changes):
            self._on_background(_color(self._values))
        return ""

    def _use_sim_time(self, values: Mapping[str, Any]) -> None:
        if "use_sim_time" in values:
            # False leaves it to the graph's parameter, as for every node here.
            self._node.clock.use(True if values["use_sim_time"] else None)


def _color(values: Mapping[str, Any]) -> Color:
    red, green, blue = (int(values[name]) for name in _CHANNELS)
    return red, green, blue


def _declared(name: str, value: Any, default: Any) -> Any:
    """Return a parameter's value from the start.

    Raises:
        LaunchError: it has another type than the default, or is out of range.
    """
    if type(value) is not type(default):
        wanted, got = parameter_type(default).word, parameter_type(value).word
        raise LaunchError(
            f"parameter '{name}' is {value!r}; it must be like {default!r}\n"
            f"  ROS says: parameter '{name}' has invalid type: expected [{wanted}] got [{got}]"
        )
    if name in _DEFAULTS and not 0 <= value <= _MAX:
        raise LaunchError(
            f"parameter '{name}' is {value}; it must be from 0 to {_MAX}\n"
            f"  ROS says: Parameter {{{name}}} doesn't comply with integer range."
        )
    return value
