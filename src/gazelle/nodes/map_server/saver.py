"""``map_saver`` of both generations: waits for a map and writes it."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.interfaces import service_type
from gazelle.mapping.grids import MapMode, MapWriteError, SaveOptions, write_map
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.lifecycle import Lifecycle
from gazelle.nodes.map_server.occupancy_grid import grid_of_message
from gazelle.nodes.parameters import number_or_end, private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable, refused

__all__ = [
    "CLI_PARAMETERS",
    "SERVER_PARAMETERS",
    "SaveRequest",
    "parse_cli",
    "parse_saver",
    "run",
    "run_cli",
    "run_server",
]

_TIMEOUT = Parameter("save_map_timeout", "number", 2.0, "how long the map is waited for", "s")
_LATE = refused(
    "maps that were published before are taken, too", "map_subscribe_transient_local", unless=True
)
CLI_PARAMETERS = ParameterTable(
    "map_saver_cli",
    "Writes the map that is published.",
    ("nav2_map_server/map_saver_cli",),
    (
        _TIMEOUT,
        *_LATE,
        *refused("--free and --occ say it", "free_thresh_default", "occupied_thresh_default"),
    ),
)
SERVER_PARAMETERS = ParameterTable(
    "map_saver_server",
    "Writes maps on request, as a managed node. What should be a number and is none ends it.",
    ("nav2_map_server/map_saver_server",),
    (
        _TIMEOUT,
        Parameter("free_thresh_default", "number", 0.25, "lighter is free, for requests with 0"),
        Parameter(
            "occupied_thresh_default", "number", 0.65, "darker is occupied, for requests with 0"
        ),
        *_LATE,
    ),
)

_USAGE = (
    "Usage: \n  map_saver -h\n  map_saver [--occ <threshold_occupied>] "
    "[--free <threshold_free>] [-f <mapname>] [ROS remapping args]"
)
_CLI_USAGE = """Usage:
  map_saver_cli [arguments] [--ros-args ROS remapping args]

Arguments:
  -h/--help
  -t <map_topic>
  -f <mapname>
  --occ <threshold_occupied>
  --free <threshold_free>
  --fmt <image_format>
  --mode trinary(default)/scale/raw

NOTE: --ros-args should be passed at the end of command line"""
_CLI_WORDS = ("-t", "-f", "--occ", "--free", "--fmt", "--mode")
_HINT_S = 5.0
_POLL_S = 0.2


@dataclass(frozen=True, slots=True)
class SaveRequest:
    """What is saved where.

    Attributes:
        stem: path without ending.
        topic: of the map.
        options: how it is written.
        help: only the usage is asked for.
    """

    stem: str
    topic: str
    options: SaveOptions
    help: bool = False


def parse_saver(argv: Sequence[str]) -> SaveRequest:
    """Read the command line of ``map_server map_saver``.

    Raises:
        LaunchError: it is wrong.
    """
    wanted = SaveRequest("map", "map", SaveOptions())
    rest = list(argv)
    while rest:
        word = rest.pop(0)
        if word == "-h":
            return replace(wanted, help=True)
        if word not in ("-f", "--occ", "--free") or not rest:
            what = f"'{word}' wants a value" if word in ("-f", "--occ", "--free") else (
                f"'{word}' is not understood. {did_you_mean(word, ('-f', '--occ', '--free'))}"
            )  # fmt: skip
            raise LaunchError(f"map_saver: {what}\n{_USAGE}")
        value = rest.pop(0)
        if word == "-f":
            wanted = replace(wanted, stem=value)
            continue
        name, low = ("threshold_occupied", 1) if word == "--occ" else ("threshold_free", 0)
        if not value.lstrip("-").isdigit() or not low <= int(value) <= 100:
            raise LaunchError(f"{name} must be between {low} and 100, not '{value}'")
        wanted = _with_threshold(wanted, word, int(value) / 100)
    if wanted.options.occupied_thresh <= wanted.options.free_thresh:
        raise LaunchError("threshold_free must be smaller than threshold_occupied")
    return wanted


def parse_cli(argv: Sequence[str]) -> SaveRequest:
    """Read the command line of ``nav2_map_server map_saver_cli``.

    Raises:
        LaunchError: it is wrong.
    """
    # Without -f the original names the file by the time, in seconds.
    wanted = SaveRequest("", "map", SaveOptions(ros_version=2))
    rest = list(argv)
    while rest:
        word = rest.pop(0)
        if word in ("-h", "--help"):
            return replace(wanted, help=True)
        if word not in _CLI_WORDS:
            hint = did_you_mean(word, _CLI_WORDS)
            raise LaunchError(f"Wrong argument: {word}. {hint}\n{_CLI_USAGE}")
        if not rest:
            raise LaunchError(f"Wrong argument: {word} should be followed by a value.")
        wanted = _taken(wanted, word, rest.pop(0))
    return wanted


def _taken(wanted: SaveRequest, word: str, value: str) -> SaveRequest:
    if word == "-t":
        return replace(wanted, topic=value)
    if word == "-f":
        return replace(wanted, stem=value)
    if word == "--fmt":
        return replace(wanted, options=replace(wanted.options, image_format=value))
    if word == "--mode":
        return replace(wanted, options=replace(wanted.options, mode=_mode(value)))
    try:
        share = float(value)
    except ValueError:
        raise LaunchError(f"{word} wants a share of 0 to 1, not '{value}'") from None
    return _with_threshold(wanted, word, share)


def _with_threshold(wanted: SaveRequest, word: str, share: float) -> SaveRequest:
    if word == "--occ":
        return replace(wanted, options=replace(wanted.options, occupied_thresh=share))
    return replace(wanted, options=replace(wanted.options, free_thresh=share))


def _mode(value: str) -> MapMode:
    names = [mode.value for mode in MapMode]
    if value not in names:
        raise LaunchError(
            f"Map mode parameter not recognized: {value}; there are {', '.join(names)}. The "
            "original saves a trinary map instead"
        )
    return MapMode(value)


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """``map_server map_saver``: save one map and end."""
    wanted = parse_saver(arguments.rest)
    return _save_once(start_node(arguments, graph), stop, wanted, _USAGE, None)


def run_cli(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """``nav2_map_server map_saver_cli``: save one map and end."""
    wanted = parse_cli(arguments.rest)
    node = start_node(arguments, graph)
    with private_parameters(node, arguments, CLI_PARAMETERS) as own:
        timeout_s = own.number("save_map_timeout")
    return _save_once(node, stop, wanted, _CLI_USAGE, timeout_s)


def _save_once(
    node: Node, stop: threading.Event, wanted: SaveRequest, usage: str, timeout_s: float | None
) -> int:
    if wanted.help:
        node.log("info", usage)
        node.shutdown()
        return 0
    if not wanted.stem:
        wanted = replace(wanted, stem=f"map_{node.clock.now_ns() // 1_000_000_000}")
    node.log("info", "Waiting for the map")
    message = _one_map(node, wanted.topic, stop, timeout_s)
    saved = message is not None and _write(node, message, wanted)
    node.shutdown()
    return 0 if saved else 1


def _one_map(node: Node, topic: str, stop: threading.Event, timeout_s: float | None) -> Any | None:
    """Return the first map, None when it does not come or the node shall stop."""
    got: list[Any] = []
    arrived = threading.Event()

    def take(message: Any) -> None:
        got.append(message)
        arrived.set()

    subscription = node.create_subscription(topic, "nav_msgs/msg/OccupancyGrid", take)
    waited_s, hinted = 0.0, False
    while not arrived.wait(_POLL_S) and not stop.is_set():
        waited_s += _POLL_S
        if timeout_s is not None and waited_s >= timeout_s:
            text = f"Failed to spin map subscription: no map on {subscription.topic} within "
            node.log("error", f"{text}{timeout_s:g} s")
            break
        if waited_s >= _HINT_S and not hinted:
            hinted = True
            text = f"nothing has come on {subscription.topic} yet; is SLAM or a map_server running?"
            node.log("warn", text)
    subscription.unregister()
    return got[0] if got else None


def _write(node: Node, message: Any, wanted: SaveRequest) -> bool:
    try:
        grid = grid_of_message(message)
        size = f"{grid.width} X {grid.height}"
        node.log("info", f"Received a {size} map @ {grid.resolution_m:.3f} m/pix")
        image, described = write_map(grid, wanted.stem, wanted.options)
    except (MapWriteError, ValueError) as error:
        node.log("error", f"Failed to save the map: {error}")
        return False
    for path in (image, described):
        node.log("info", f"Writing map occupancy data to {path}")
    node.log("info", "Done" if wanted.options.ros_version == 1 else "Map saved successfully")
    return True


def run_server(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """``nav2_map_server map_saver_server``: save maps on request, as a managed node.

    Raises:
        LaunchError: a parameter is no number.
    """
    node = start_node(arguments, graph)
    try:
        with private_parameters(node, arguments, SERVER_PARAMETERS) as own:
            timeout_s, occupied_thresh, free_thresh = (
                number_or_end(own, key)
                for key in ("save_map_timeout", "occupied_thresh_default", "free_thresh_default")
            )
    except LaunchError:
        node.shutdown()
        raise
    lifecycle = Lifecycle(node, {})

    def on_save(request: Any) -> Any:
        response = service_type("nav2_msgs/srv/SaveMap").Response()
        if not lifecycle.active:
            node.log("warn", "Received SaveMap request but not in ACTIVE state, ignoring!")
            return response
        topic = request.map_topic or "map"
        options = SaveOptions(
            2,
            _request_mode(node, request.map_mode),
            request.image_format,
            float(request.occupied_thresh) or occupied_thresh,
            float(request.free_thresh) or free_thresh,
        )
        node.log("info", f"Saving map from '{topic}' topic to '{request.map_url}' file")
        message = _one_map(node, topic, stop, timeout_s)
        wanted = SaveRequest(request.map_url, topic, options)
        response.result = message is not None and _write(node, message, wanted)
        return response

    node.create_service("~/save_map", service_type("nav2_msgs/srv/SaveMap"), on_save)
    arguments.ready()
    while not stop.wait(_POLL_S) and not lifecycle.finalized:
        pass
    node.shutdown()
    return 0


def _request_mode(node: Node, value: str) -> MapMode:
    names = [mode.value for mode in MapMode]
    if value in names:
        return MapMode(value)
    if value:
        text = f"Map mode parameter not recognized: '{value}', using default value (trinary)"
        node.log("warn", text)
    return MapMode.TRINARY
