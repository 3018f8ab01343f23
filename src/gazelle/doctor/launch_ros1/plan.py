"""From a launch to what its simulator is brought up with."""

from __future__ import annotations

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.dry_start import ControllerStart, StartPlan
from gazelle.doctor.launch_ros1.launched_nodes import Launched, LaunchedNode, Role
from gazelle.errors import LaunchError
from gazelle.nodes.controller_manager.spawner import is_ros2, spawner_parser
from gazelle.nodes.controller_manager.spawner_ros2 import spawner_options

__all__ = ["controller_start", "start_plan"]

_LOADS = frozenset({"load", "spawn", "sp", "start"})


def start_plan(launched: Launched, server: LaunchedNode, diagnostics: Diagnostics) -> StartPlan:
    """Return what a simulator of a launch is brought up with.

    Args:
        launched: the launch.
        server: the simulator among its nodes.
        diagnostics: receives spawners whose arguments are wrong.
    """
    starts = [
        controller_start(node, diagnostics) for node in launched.of_role(Role.CONTROLLER_SPAWNER)
    ]
    return StartPlan(
        server=server.program,
        parameters=dict(launched.config.params),
        text_files=tuple(dict.fromkeys(launched.config.text_files)),
        spawners=tuple(node.program for node in launched.of_role(Role.MODEL_SPAWNER)),
        controllers=tuple(start for start in starts if start is not None),
        started_by=1,
    )


def controller_start(node: LaunchedNode, diagnostics: Diagnostics) -> ControllerStart | None:
    """Return what a spawner of controllers would do; None when its arguments are wrong."""
    assert node.executable is not None and node.executable.builtin is not None
    executable = node.executable.builtin.executable
    try:
        if executable == "controller_manager":
            return _of_command(node)
        if executable == "spawner.py" or is_ros2(node.program.words):
            return _of_ros2(node)
        return _of_ros1(node)
    except LaunchError as error:
        text = f"'{node.full_name}' ends at once: {error}"
        diagnostics.report("doctor.bad-arguments", text, node.spec.span)
        return None


def _of_ros1(node: LaunchedNode) -> ControllerStart:
    options = spawner_parser().parse_args(list(node.program.words))
    name = f"{options.namespace.rstrip('/')}/controller_manager".lstrip("/")
    if options.namespace.startswith("/"):
        name = f"/{name}"
    return ControllerStart(
        node.resolve(name), tuple(options.controllers), node.program, starts=not options.stopped
    )


def _of_ros2(node: LaunchedNode) -> ControllerStart:
    options = spawner_options(node.program.words)
    name = options.controller_manager
    if options.namespace and not name.startswith("/"):
        name = f"/{options.namespace.strip('/')}/{name}"
    return ControllerStart(
        node.resolve(name),
        tuple(options.controller_names),
        node.program,
        options.controller_type,
        tuple(options.param_file),
        not (options.inactive or options.load_only),
    )


def _of_command(node: LaunchedNode) -> ControllerStart | None:
    """``controller_manager spawn NAME``: other commands change nothing before the first step."""
    words = [word for word in node.program.words if not word.startswith("-")]
    if not words or words[0] not in _LOADS:
        return None
    starts = words[0] != "load"
    return ControllerStart(
        node.resolve("controller_manager"), tuple(words[1:]), node.program, starts=starts
    )
