"""The process that launch files start as gzserver or gazebo."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from gazelle._version import __version__
from gazelle.description.model import World
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity, brief, did_you_mean, render
from gazelle.errors import GazelleError, NotFoundError
from gazelle.graph import offer_loggers
from gazelle.graph.console import aside_path, write_aside
from gazelle.graph.gazebo_names import SHOWN_SPACE, world_space
from gazelle.graph.ros2_node_parameters import Descriptor, NodeParameters
from gazelle.simulator.description_sources import world_from
from gazelle.simulator.divergence_recovery import DIVERGENCE, OnDivergence
from gazelle.simulator.gazebo_ros.api import ROS2_PLUGINS, offer_gazebo_ros
from gazelle.simulator.gui import offer_views
from gazelle.simulator.gzserver_command_line import HELP, ServerOptions, read_server_options
from gazelle.simulator.gzserver_ros_parameters import (
    CLOCK_RATE,
    ROS1_CLOCK_RATE,
    read_server_parameters,
    report_unread,
)
from gazelle.simulator.plugins.gz_builtin_systems import TABLE as GZ_SYSTEMS
from gazelle.simulator.plugins.registry import known_names, plain_name
from gazelle.simulator.world_server import ServerSettings, WorldServer
from gazelle.workspace import Workspace

if TYPE_CHECKING:
    from gazelle.description.model import World
    from gazelle.graph import Graph
    from gazelle.parameters.reader import ParameterReader

__all__ = ["check_server_plugins", "ros2_plugins_of", "ros_version_of", "serve"]

# What gazebo_ros declares; the clock comes more often here as long as nobody sets it.
_DECLARED_RATE_HZ = 10.0
_ROS1_PLUGINS = frozenset({"gazebo_ros_api_plugin", "gazebo_ros_paths_plugin"})


class _Arguments(Protocol):
    """What a node is told when it starts."""

    @property
    def name(self) -> str: ...
    @property
    def namespace(self) -> str: ...
    @property
    def remappings(self) -> Mapping[str, str]: ...
    @property
    def params(self) -> Mapping[str, Any]: ...
    @property
    def rest(self) -> tuple[str, ...]: ...
    @property
    def started_by(self) -> int: ...
    @property
    def parameter_files(self) -> tuple[Path, ...]: ...


def serve(
    arguments: _Arguments,
    graph: Graph,
    stop: threading.Event,
    *,
    falls_back: bool = True,
    found: Diagnostics | None = None,
) -> int:
    """Run a world on a graph until told to stop.

    Args:
        arguments: node name, namespace, remappings and the words of gzserver.
        graph: where topics and services go.
        stop: set from outside (signals) to end.
        falls_back: run the empty world where the named one is not found, as Gazebo Classic does.
        found: of whoever calls, to be told with the rest.

    Returns:
        the exit code: 0, or 1 when the world cannot be read or the physics diverged.
    """
    diagnostics = Diagnostics() if found is None else found
    options = read_server_options(arguments.rest, diagnostics)
    if options.shows_help or options.shows_version:
        sys.stdout.write(HELP if options.shows_help else f"Gazelle {__version__}\n")
        return 0
    node = graph.create_node(
        _node_name(arguments.name),
        namespace=arguments.namespace,
        remappings=dict(arguments.remappings),
    )
    try:
        version = ros_version_of(options, arguments.started_by)
        if world_space(version, is_gz=options.is_gz) == SHOWN_SPACE:
            offer_loggers(node)
        own = read_server_parameters(arguments, node, diagnostics, ros_version=version)
        rate_hz = _clock_rate(own)
        if not options.is_gz:
            report_unread(own)
        declared = None
        if version == 2 and not options.is_gz:
            declared = _offer_parameters(node, rate_hz, own.raw(DIVERGENCE))
        workspace = Workspace.discover()
        world = _world(options, node, workspace, diagnostics, falls_back=falls_back)
        ros = (version, rate_hz, _divergence(node, declared))
        return _serve_world(options, world, workspace, node, diagnostics, stop, ros)
    except GazelleError as error:
        _show(node, diagnostics)
        node.log("fatal", str(error))
        return 1
    finally:
        node.shutdown()


def _serve_world(
    options: ServerOptions,
    world: World,
    workspace: Workspace,
    node: Any,
    diagnostics: Diagnostics,
    stop: threading.Event,
    ros: tuple[int, float | None, Callable[[], OnDivergence]],
) -> int:
    """Run the world.

    `ros` is the version of ROS, the clock's rate, None where nobody chose, and who is asked what
    becomes of a world that diverges.
    """
    ros_version, clock_rate_hz, on_divergence = ros
    server = WorldServer(
        world,
        node=node,
        workspace=workspace,
        diagnostics=diagnostics,
        settings=ServerSettings(
            options.seed, options.mode, options.paused, warm_cameras=True, ros_version=ros_version
        ),
    )
    server.on_divergence = on_divergence
    check_server_plugins(options, diagnostics)
    _show(node, diagnostics, verbose=options.verbose)
    offer_gazebo_ros(
        server,
        ros2=ros2_plugins_of(options),
        is_gz=options.is_gz,
        report=lambda found: _show(node, found, verbose=options.verbose),
        clock_rate_hz=clock_rate_hz,
    )
    offer_views(server, is_gz=options.is_gz or _names_gz_systems(world))
    if world_space(ros_version, is_gz=options.is_gz) == SHOWN_SPACE:
        # Plug-ins of ROS 1 say this; ROS 2 and gz have neither.
        node.log("info", "Finished loading Gazebo ROS API Plugin.")
        node.log("info", "Physics dynamic reconfigure ready.")
    threading.Thread(target=_stop_with, args=(stop, server), daemon=True).start()
    try:
        server.run(options.iterations)
        if options.iterations:
            text = f"state hash {server.engine.state_hash()} at {server.time_ns * 1e-9:.9f} s"
            node.log("info", text)
    finally:
        server.close()
        dropped = sum(server.frames.dropped.values())
        if dropped:
            node.log("info", f"{dropped} camera frames were dropped, rendering was late")
    return 0


def _divergence(node: Any, declared: NodeParameters | None) -> Callable[[], OnDivergence]:
    """Return what tells the parameter `DIVERGENCE` as it is then: the node's own in ROS 2."""

    def now() -> OnDivergence:
        if declared is not None:
            value = declared.values[DIVERGENCE]
        else:
            value = node.parameters.get(f"~{DIVERGENCE}", OnDivergence.PAUSE.value)
        problem = _divergence_problem(value)
        if problem:
            node.log("warn", f"{problem}; it is paused")
        return OnDivergence.PAUSE if problem else OnDivergence(value)

    return now


def _divergence_problem(value: Any) -> str:
    choices = [one.value for one in OnDivergence]
    return "" if value in choices else f"parameter '{DIVERGENCE}' is {value!r}, none of {choices}"


def _offer_parameters(
    node: Any, clock_rate_hz: float | None, divergence: str | None
) -> NodeParameters:
    """Offer what ROS 2's node ``gazebo`` declares, both read when it starts, and one of ours."""
    rate_hz = _DECLARED_RATE_HZ if clock_rate_hz is None else clock_rate_hz
    fixed = Descriptor(read_only=True)
    return NodeParameters(
        node,
        node.name,
        {CLOCK_RATE: rate_hz, "use_sim_time": True, DIVERGENCE: divergence or "pause"},
        lambda changes: _divergence_problem(changes[DIVERGENCE]) if DIVERGENCE in changes else "",
        descriptors={CLOCK_RATE: fixed, "use_sim_time": fixed},
        now_ns=node.clock.now_ns,
    )


def _clock_rate(own: ParameterReader) -> float | None:
    """Return how often the clock is to be told, None where nobody says it."""
    said = next((key for key in (CLOCK_RATE, ROS1_CLOCK_RATE) if own.has(key)), None)
    return None if said is None else own.number(said)


def _world(
    options: ServerOptions,
    node: Any,
    workspace: Workspace,
    diagnostics: Diagnostics,
    *,
    falls_back: bool,
) -> World:
    """Return the world that is named, or the empty one with an error when it is not there."""
    try:
        return world_from(options.world or "empty", workspace, diagnostics)
    except NotFoundError as error:
        if error.kind != "world" or not falls_back:
            raise
        node.log("error", f"Could not open file: {error}")
    node.log("warn", "Falling back on worlds/empty.world")
    return world_from("empty", workspace, diagnostics)


def ros2_plugins_of(options: ServerOptions) -> frozenset[str]:
    """Return the plug-ins of ROS 2's gazebo_ros that the command line names."""
    return ROS2_PLUGINS & {plain_name(name) for name in options.plugins}


def ros_version_of(options: ServerOptions, started_by: int) -> int:
    """Return the version of ROS that a simulator is started for; 0 for none, or for both.

    Args:
        options: of the command line; the plug-ins of either gazebo_ros tell.
        started_by: the version of the launch file or command, 0 for a bare shell.
    """
    names = {plain_name(name) for name in options.plugins}
    told = {
        version
        for version, plugins in ((1, _ROS1_PLUGINS), (2, ROS2_PLUGINS))
        if version == started_by or not names.isdisjoint(plugins)
    }
    return told.pop() if len(told) == 1 else 0


def _node_name(name: str) -> str:
    """Gazebo's own node is called gazebo whatever the executable was."""
    return "gazebo" if name in {"gzserver", "debug", "perf"} else name


def _stop_with(stop: threading.Event, server: WorldServer) -> None:
    stop.wait()
    server.stop()


def check_server_plugins(options: ServerOptions, diagnostics: Diagnostics) -> None:
    """Report what is done with the server plug-ins that the command line names."""
    known = known_names()
    for library in options.plugins:
        name = plain_name(library)
        if name in known:
            text = f"server plug-in '{library}' is part of Gazelle"
            diagnostics.report("simulator.server-plugin", text)
        else:
            text = f"server plug-in '{library}' is compiled code that Gazelle does not have"
            diagnostics.report("plugin.unknown", text, fix=did_you_mean(name, known))


def _show(node: Any, found: Iterable[Diagnostic], *, verbose: bool = True) -> None:
    """Print findings on standard error; notices only when asked to be verbose, and summed.

    That another model is in the world than the one it names is always said: lidars and cameras
    see it.
    """
    least = Severity.INFO if verbose else Severity.WARNING
    items = [item for item in found if item.severity >= least or item.code == "load.stand-in"]
    shown, kept = brief(items, str(aside_path(node)))
    render(shown if not kept or write_aside(node, map(str, kept)) else items)


def _names_gz_systems(world: World) -> bool:
    names = (plain_name(plugin.filename) for plugin in world.plugins)
    return any(name in GZ_SYSTEMS.parameters.types for name in names)
