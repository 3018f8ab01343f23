"""The windows of ROS and Gazebo by their names, each a panel of the page.

| command | its words |
| --- | --- |
| rviz, rviz2 | ``-d FILE.rviz`` or ``FILE.rviz``, ``-f FRAME`` |
| rqt_plot | ``TOPIC/FIELD[:FIELD] …``; a topic or sub-message stands for all its numbers |
| rqt_image_view, image_view | ``TOPIC``; ``image:=TOPIC`` |
| rqt_bag | ``FILE …`` |
| rqt_gui, rqt | ``-s PLUGIN``, of rqt's own or a user's package, ``--perspective-file FILE`` |
| rqt_robot_steering | ``~default_topic`` |
| moveit_setup_assistant | ``--config_pkg PACKAGE``, ``--urdf_path FILE`` |

Other words are those of windows (``--force-discover``, geometries) and mean nothing to a page.
"""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node
from gazelle.studio.windows.page_owner import Request, is_switched_off, present, say

__all__ = [
    "action_caller",
    "gzclient",
    "image_view",
    "moveit_setup_assistant",
    "rqt",
    "rqt_action",
    "rqt_bag",
    "rqt_console",
    "rqt_ez_publisher",
    "rqt_graph",
    "rqt_logger_level",
    "rqt_msg",
    "rqt_plot",
    "rqt_publisher",
    "rqt_reconfigure",
    "rqt_robot_steering",
    "rqt_service_caller",
    "rqt_srv",
    "rqt_tf_tree",
    "rqt_top",
    "rqt_topic",
    "run_view",
    "rviz",
]

_FIELDS = re.compile(r"^(?P<start>[^:]*/)(?P<fields>[^/]+(?::[^/]+)+)$")
_PLUGIN = re.compile(r"^(?P<package>\w+?)(?:[./].*)?$")
_VALUED = ("-d", "--display-config", "-f", "--fixed-frame", "-s", "--standalone",
           "--perspective-file", "-p", "--perspective", "-t", "--ht", "--args",
           "--config_pkg", "-c", "--urdf_path", "-u")  # fmt: skip
_Node = Callable[[NodeArguments, Graph, threading.Event], int]


def run_view(
    panel: str,
    params: dict[str, Any],
    arguments: NodeArguments,
    graph: Graph,
    stop: threading.Event,
) -> int:
    """Be a node that shows a panel until told to stop; launch files count on its staying alive."""
    node = start_node(arguments, graph)
    # A simulator says the time at every step; the page's server follows it while a page is open.
    graph.clock.leave(node)
    if is_switched_off():
        node.log("info", f"[{panel}] no window opens: GAZELLE_STUDIO=0; the node stays alive")
        stop.wait()
    else:
        present(node, Request(panel, params), stop, say)
    node.shutdown()
    return 0


def gzclient(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Show the world."""
    return run_view("gazebo", {}, arguments, graph, stop)


def rviz(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Show displays, those of a ``.rviz`` file if one is named."""
    positional, options = _parsed(arguments.rest)
    file = options.get("-d") or options.get("--display-config") or next(iter(positional), "")
    frame = options.get("-f") or options.get("--fixed-frame") or ""
    params = {"file": _path(file)} if file else {}
    return run_view("rviz", params | ({"frame": frame} if frame else {}), arguments, graph, stop)


def moveit_setup_assistant(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Make a MoveIt config package, or change one."""
    _, options = _parsed(arguments.rest)
    package = options.get("--config_pkg") or options.get("-c") or ""
    file = options.get("--urdf_path") or options.get("-u") or ""
    params = {"package": package} if package else {"file": _path(file)} if file else {}
    return run_view("moveit_setup_assistant", params, arguments, graph, stop)


def rqt_plot(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Show numbers over time."""
    positional, _ = _parsed(arguments.rest)
    curves = [curve for argument in positional for curve in _curves(argument)]
    return run_view("rqt_plot", {"curves": curves} if curves else {}, arguments, graph, stop)


def image_view(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Show a picture."""
    positional, _ = _parsed(arguments.rest)
    topic = next(iter(positional), "") or dict(arguments.remappings).get("image", "")
    params = {"topic": _absolute(topic)} if topic else {}
    return run_view("rqt_image_view", params, arguments, graph, stop)


def rqt_bag(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Show a bag."""
    positional, _ = _parsed(arguments.rest)
    params = {"path": _path(positional[0])} if positional else {}
    return run_view("rqt_bag", params, arguments, graph, stop)


def rqt(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Show one plug-in's panel, a perspective, or what was shown last."""
    _, options = _parsed(arguments.rest)
    plugin = options.get("-s") or options.get("--standalone") or ""
    if plugin:
        found = _PLUGIN.match(plugin)
        from gazelle.studio.plugins.panel_sources import own_panel

        panel = own_panel(plugin) or (found["package"] if found else plugin)
        return run_view(panel, {}, arguments, graph, stop)
    file = options.get("--perspective-file", "")
    params = {"perspective": _path(file)} if file else {}
    return run_view("rqt_gui", params, arguments, graph, stop)


def _opens(panel: str) -> _Node:
    def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
        return run_view(panel, {}, arguments, graph, stop)

    return run


def _parsed(rest: Sequence[str]) -> tuple[list[str], dict[str, str]]:
    """Return the plain words, and the options that have a value."""
    positional: list[str] = []
    options: dict[str, str] = {}
    left = iter(rest)
    for argument in left:
        name, sign, value = argument.partition("=")
        if name in _VALUED:
            options[name] = value if sign else next(left, "")
        elif not argument.startswith("-"):
            positional.append(argument)
    return positional, options


def _curves(argument: str) -> list[str]:
    """``/pose/x:y`` is ``/pose/x`` and ``/pose/y``."""
    found = _FIELDS.match(argument)
    names = (
        [found["start"] + field for field in found["fields"].split(":")] if found else [argument]
    )
    return [_absolute(name) for name in names]


def _absolute(topic: str) -> str:
    return topic if topic.startswith("/") else f"/{topic}"


def _path(file: str) -> str:
    """The page's server may run in another folder."""
    return str(Path(file).expanduser().absolute())


action_caller = _opens("action_caller")
rqt_action = _opens("rqt_action")
rqt_console = _opens("rqt_console")
rqt_ez_publisher = _opens("rqt_ez_publisher")
rqt_graph = _opens("rqt_graph")
rqt_logger_level = _opens("rqt_logger_level")
rqt_msg = _opens("rqt_msg")
rqt_publisher = _opens("rqt_publisher")
rqt_reconfigure = _opens("rqt_reconfigure")
rqt_robot_steering = _opens("rqt_robot_steering")
rqt_service_caller = _opens("rqt_service_caller")
rqt_srv = _opens("rqt_srv")
rqt_tf_tree = _opens("rqt_tf_tree")
rqt_top = _opens("rqt_top")
rqt_topic = _opens("rqt_topic")
