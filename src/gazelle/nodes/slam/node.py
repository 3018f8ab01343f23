"""The SLAM nodes: gmapping, slam_karto, hector_mapping, cartographer_node, slam_toolbox."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.interfaces import service_type
from gazelle.mapping.se2 import Poses
from gazelle.mapping.slam.kernel_warm_up import warm_up
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.gflags import Kind, read_flags
from gazelle.nodes.map_server.occupancy_grid import message_of_grid
from gazelle.nodes.parameters import (
    log_findings,
    node_reader,
    parameter_tree,
    start_node,
    ticks,
    use_own_sim_time,
)
from gazelle.nodes.slam.cartographer.configuration import flags_of, read_configuration
from gazelle.nodes.slam.explore_lite import run_explore
from gazelle.nodes.slam.mapper import Mapper
from gazelle.nodes.slam.parameters import SLAM_NODES, SlamNode, SlamOptions, options_of
from gazelle.nodes.slam.slam_toolbox import ToolboxServices
from gazelle.parameters.trees import nested
from gazelle.workspace.ament_index import known_workspace

__all__ = [
    "run_cartographer",
    "run_explore",
    "run_gmapping",
    "run_hector",
    "run_karto",
    "run_localization",
    "run_occupancy_grid",
    "run_toolbox",
]

_NANO = 1_000_000_000
_POLL_S = 0.02
_MODES = ("mapping", "localization")
_GRID_FLAGS: dict[str, Kind] = {
    **dict.fromkeys(("resolution", "publish_period_sec"), "double"),
    **dict.fromkeys(("include_frozen_submaps", "include_unfrozen_submaps", "logtostderr"), "bool"),
    "occupancy_grid_topic": "string",
}  # fmt: skip


def run_gmapping(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """``gmapping/slam_gmapping``."""
    return _run(SLAM_NODES["gmapping"], arguments, graph, stop)


def run_karto(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """``slam_karto/slam_karto``."""
    return _run(SLAM_NODES["slam_karto"], arguments, graph, stop)


def run_hector(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """``hector_mapping/hector_mapping``; it uses odometry, which the original does not need."""
    return _run(SLAM_NODES["hector_mapping"], arguments, graph, stop)


def run_toolbox(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """slam_toolbox's mapping nodes."""
    return _run(SLAM_NODES["slam_toolbox"], arguments, graph, stop)


def run_localization(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """slam_toolbox's localization node: in the map of ``map_file_name``."""
    slam_node = SLAM_NODES["slam_toolbox"]
    base = replace(slam_node.base, mode="localization")
    uses = {key: option for key, option in slam_node.uses.items() if option != "mode"}
    return _run(replace(slam_node, base=base, uses=uses), arguments, graph, stop)


def run_cartographer(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """``cartographer_ros/cartographer_node``: frames and ranges of its Lua file."""
    flags = flags_of(arguments.rest)
    package = known_workspace().packages.get("cartographer")
    folders = (package.path / "configuration_files",) if package else ()
    given = read_configuration(flags, folders)
    idle = sorted(set(flags) - {"configuration_directory", "configuration_basename"})
    return _run(SLAM_NODES["cartographer"], arguments, graph, stop, given, idle)


def run_occupancy_grid(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """``cartographer_occupancy_grid_node``: cartographer_node publishes the map itself here."""
    node = start_node(arguments, graph)
    node.log("info", "the map comes from cartographer_node itself, drawn with its own resolution")
    flags = sorted(read_flags(arguments.rest, _GRID_FLAGS))
    if flags:
        node.log("info", f"options that have no effect here: -{', -'.join(flags)}")
    arguments.ready()
    stop.wait()
    node.shutdown()
    return 0


def _run(
    slam_node: SlamNode,
    arguments: NodeArguments,
    graph: Graph,
    stop: threading.Event,
    given: Mapping[str, Any] = MappingProxyType({}),
    idle_flags: Sequence[str] = (),
) -> int:
    node = start_node(arguments, graph)
    use_own_sim_time(node, arguments.params)
    if idle_flags:
        node.log("warn", f"options that have no effect here: -{', -'.join(idle_flags)}")
    options = _options(slam_node, arguments, node, given)
    mapper = Mapper(node, options)
    _offer(node, mapper, slam_node, options)
    done = threading.Event()
    # Costmaps and displays wait for the map's frame, which needs no scan.
    if options.publishes_tf and options.tf_period_s > 0:
        threading.Thread(target=_publish_transforms, args=(node, mapper, done), daemon=True).start()
    warm_up()
    mapper.listen()
    threading.Thread(target=_publish_maps, args=(node, mapper, done), daemon=True).start()
    arguments.ready()
    while not stop.wait(_POLL_S):
        mapper.settle()
    done.set()
    node.shutdown()
    return 0


def _options(
    slam_node: SlamNode, arguments: NodeArguments, node: Node, given: Mapping[str, Any]
) -> SlamOptions:
    tree = {**nested(given), **parameter_tree(node, arguments)}
    found = Diagnostics()
    settings = node_reader(slam_node.table, tree, node.resolve_name("~"), found)
    options = options_of(slam_node, settings)
    settings.report_unknown()
    log_findings(node, found)
    if options.mode not in _MODES:
        hint = did_you_mean(options.mode, _MODES) or f"there are {' and '.join(_MODES)}"
        raise LaunchError(f"mode is '{options.mode}'; {hint}")
    return options


def _offer(node: Node, mapper: Mapper, slam_node: SlamNode, options: SlamOptions) -> None:
    get_map: Any = service_type("nav_msgs/srv/GetMap")

    def on_get_map(_request: Any) -> Any:
        grid = mapper.grid()
        response = get_map.Response()
        if grid is not None:
            now_ns = node.clock.now_ns()
            response.map = message_of_grid(grid, options.map_frame, now_ns)
        return response

    if not slam_node.services:
        node.create_service("dynamic_map", get_map, on_get_map)
        return
    node.create_service("~/dynamic_map", get_map, on_get_map)
    services = ToolboxServices(node, mapper)
    if options.map_file:
        start = options.start_pose if len(options.start_pose) == 3 else None
        why = services.load(Path(options.map_file), start, keeps=options.mode == "localization")
        if why:
            node.log("error", why)
    elif options.mode == "localization":
        node.log("warn", "localization needs a map: give map_file_name, or call deserialize_map; "
                         "until then a map is made")  # fmt: skip


def _publish_maps(node: Node, mapper: Mapper, done: threading.Event) -> None:
    drawn: tuple[int, Poses] | None = None
    period_ns = max(int(mapper.options.map_period_s * _NANO), _NANO // 10)
    for _now_ns in ticks(node, period_ns, done):
        poses = mapper.engine.keyframes.poses
        if not len(poses):
            continue
        state = len(poses), poses[-1].copy()
        if drawn is None or drawn[0] != state[0] or (drawn[1] != state[1]).any():
            mapper.publish_map()
            drawn = state


def _publish_transforms(node: Node, mapper: Mapper, done: threading.Event) -> None:
    for now_ns in ticks(node, int(mapper.options.tf_period_s * _NANO), done):
        mapper.publish_transform(now_ns)
