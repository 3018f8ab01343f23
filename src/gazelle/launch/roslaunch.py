"""What the ``roslaunch`` command does once its options are read."""

from __future__ import annotations

import contextlib
import os
import sys
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from gazelle.description.robot_description import (
    TEXT_FILES_VARIABLE,
    TEXT_NAME,
    copy_name,
    file_of_text,
)
from gazelle.diagnostics import Diagnostics, render
from gazelle.documents.yaml import dump_yaml
from gazelle.errors import GraphError, LaunchError
from gazelle.graph import Graph, NoGraphError
from gazelle.graph.gazebo_names import offered_name
from gazelle.interfaces import service_type
from gazelle.launch.console import Console, RunLog, begin_log, run_log, summary
from gazelle.launch.cpp_nodes import all_of_package, compiled_ahead
from gazelle.launch.environment import node_environment
from gazelle.launch.launch_config import LaunchConfig, NodeTag
from gazelle.launch.node_commands import Executable, find_executable
from gazelle.launch.real_ros import join, real_ros
from gazelle.launch.spawner_sequence import (
    HeldStart,
    holds_time,
    is_simulator,
    starts_in_turn,
    with_simulator_args,
)
from gazelle.launch.supervisor import StopTimes, Supervisor
from gazelle.user_folders import ros_home
from gazelle.workspace import Package, Workspace

__all__ = ["LaunchOptions", "find_executables", "launch"]

_ROSOUT = NodeTag("rosout", "rosout", "rosout")
_LOADS = (["load"], ["standalone"])
_UNPAUSE = "/gazebo/unpause_physics"
_UNPAUSE_S = 60.0
_LOOK_AGAIN_S = 0.2


@dataclass(frozen=True, slots=True)
class LaunchOptions:
    """Options of ``roslaunch`` that change how nodes run.

    Attributes:
        screen: all output to the terminal.
        log: all output to files.
        required: every node is required.
        wait: wait for a graph that is there instead of starting one.
        port: port of the graph's hub, None for the default.
        show_summary: print the SUMMARY block.
        run_id: identifier of the run, made up when empty.
        simulator_args: words added to every simulator server (``--fast``, ``--lockstep``).
        lockstep: every run is the same: time stands still until all spawners have ended.
        iterations: the launch ends after so many steps of the simulator, 0 for never.
        stop_times: patience at the end.
        bridge: join a real ROS that is there.
    """

    screen: bool = False
    log: bool = False
    required: bool = False
    wait: bool = False
    port: int | None = None
    show_summary: bool = True
    run_id: str = ""
    simulator_args: tuple[str, ...] = ()
    lockstep: bool = False
    iterations: int = 0
    stop_times: StopTimes | None = None
    bridge: bool = True


def launch(
    config: LaunchConfig,
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    options: LaunchOptions,
    title: str,
) -> int:
    """Set the parameters, start every node and stay until the launch is over.

    Args:
        config: what the launch files came to.
        workspace: where packages are.
        diagnostics: findings of reading; those of finding executables are added and printed.
        options: of the command line.
        title: the launch file's path, for the terminal.

    Returns:
        The exit code: 1 when a node could not be found or a required one failed.

    Raises:
        LaunchError: the graph cannot be opened.
    """
    console = Console()
    with _graph(options, console) as graph:
        seen = real_ros(os.environ, graph.node_names) if options.bridge else []
        log = run_log(graph, options.run_id, next((one.run_id for one in seen if one.run_id), ""))
        with begin_log(console, log.folder):
            nodes, missing = find_executables(config, workspace, diagnostics, options)
            render(diagnostics)
            run = _Run(graph, workspace, console)
            environment = _environment(config, options, workspace, log)
            hopeless = bool(missing) and not nodes
            with _supervisor(run, environment, log, options, console) as supervisor:
                if not hopeless:
                    join(seen, supervisor, graph, console)
                _set_params(config, graph, log.run_id)
                if options.show_summary:
                    console.plain(summary(config, {**config.params, **_core_params()}))
                _announce(graph, console, title, log)
                if hopeless:
                    console.error("none of the nodes can be started, roslaunch will exit")
                    return 1
                code = run(supervisor, nodes, in_turn=options.lockstep and starts_in_turn(nodes))
    console.bold("done")
    return 1 if missing else code


def _environment(
    config: LaunchConfig, options: LaunchOptions, workspace: Workspace, log: RunLog
) -> Mapping[str, str]:
    text_files = os.pathsep.join(_text_files(config, log.folder))
    return {**node_environment(_environ(options), workspace), TEXT_FILES_VARIABLE: text_files}


def _supervisor(
    run: _Run,
    environment: Mapping[str, str],
    log: RunLog,
    options: LaunchOptions,
    console: Console,
) -> Supervisor:
    return Supervisor(
        environment,
        log.folder,
        _cwd(environment),
        console=console,
        stop_times=options.stop_times,
        on_end=run.ended,
        on_ready=run.ready,
    )


class _Run:
    """Starts the nodes: all at once, or spawners in turn while time is held."""

    def __init__(self, graph: Graph, workspace: Workspace, console: Console) -> None:
        self._graph = graph
        self._workspace = workspace
        self._console = console
        self._held: HeldStart | None = None

    def __call__(
        self, supervisor: Supervisor, nodes: Sequence[tuple[NodeTag, Executable]], *, in_turn: bool
    ) -> int:
        """Start everything, spawners in turn when asked for, and stay until the launch is over."""
        if not nodes and not self._graph.is_hub:
            # Parameters are set, and who carries the graph keeps them.
            self._console.plain("No processes to monitor")
            self._console.plain("shutting down processing monitor...")
            return 0
        # Another launch on this graph has it already.
        has_rosout = _ROSOUT.full_name in self._graph.node_names()
        rosout = (
            None
            if has_rosout
            else find_executable(
                "rosout", "rosout", workspace=self._workspace, diagnostics=Diagnostics()
            )
        )
        if rosout is not None and supervisor.start(_ROSOUT, rosout, core=True):
            self._console.plain("started core service [/rosout]")
        # A pause that a file asks for is the user's to end.
        held = in_turn and holds_time(nodes)
        if in_turn:
            release = self._release if held else _stay_paused
            self._held = HeldStart(nodes, start=supervisor.start, release=release)
        for spec, executable in HeldStart.others(nodes) if in_turn else nodes:
            pause = held and is_simulator(executable)
            supervisor.start(with_simulator_args(spec, ["-u"]) if pause else spec, executable)
        if self._held is not None:
            self._held.begin()
        return supervisor.run()

    def ended(self, spec: NodeTag) -> None:
        """Hear that a node has ended."""
        if self._held is not None:
            self._held.ended(spec)

    def ready(self, spec: NodeTag) -> None:
        """Hear that a spawner of controllers has started them and stays."""
        if self._held is not None:
            self._held.ready(spec)

    def _release(self) -> None:
        """Let time go on, without keeping the supervisor from its events."""
        threading.Thread(target=_unpause, args=(self._graph,), daemon=True).start()


def _stay_paused() -> None:
    """Time goes on when the user says so."""


def _unpause(graph: Graph) -> None:
    node = graph.create_node("roslaunch", anonymous=True, rosout=False)
    kind = service_type("std_srvs/Empty")
    # The launch may end while this waits for the simulator.
    with contextlib.suppress(GraphError):
        client = node.create_client(offered_name(graph, _UNPAUSE, _UNPAUSE_S), kind)
        if client.available:
            client.call(kind.Request())
        node.shutdown()


def find_executables(
    config: LaunchConfig, workspace: Workspace, diagnostics: Diagnostics, options: LaunchOptions
) -> tuple[list[tuple[NodeTag, Executable]], int]:
    """Return every node with its command, C++ compiled, and how many have none."""
    commands: list[Executable | None] = []
    for spec in config.nodes:
        commands.append(
            find_executable(
                spec.package,
                spec.type,
                workspace=workspace,
                diagnostics=diagnostics,
                span=spec.span,
            )
        )
        if spec.machine and spec.machine != "localhost":
            message = f"node '{spec.name}' asks for machine '{spec.machine}'; it runs here"
            diagnostics.report("launch.remote-machine", message, spec.span)
    libraries = [
        all_of_package(package, spec.span)
        for spec in config.nodes
        if (package := _package_of_nodelet(spec, workspace)) is not None
    ]
    ready = compiled_ahead([*commands, *libraries], workspace=workspace, diagnostics=diagnostics)
    commands = ready[: len(commands)]
    found = [
        (_with_options(spec, executable, options), executable)
        for spec, executable in zip(config.nodes, commands, strict=True)
        if executable is not None
    ]
    return found, len(config.nodes) - len(found)


def _package_of_nodelet(spec: NodeTag, workspace: Workspace) -> Package | None:
    """Return the package whose library a nodelet's process loads; None for others."""
    words = spec.args.split()
    if (spec.package, spec.type) != ("nodelet", "nodelet") or words[:1] not in _LOADS:
        return None
    package = workspace.packages.get("".join(words[1:2]).partition("/")[0])
    is_source = package is not None and package.prefix is None and not package.is_builtin
    return package if is_source else None


def _with_options(spec: NodeTag, executable: Executable, options: LaunchOptions) -> NodeTag:
    output = "screen" if options.screen else "log" if options.log else spec.output
    required = spec.required or options.required
    if is_simulator(executable):
        argv = list(options.simulator_args)
        if options.iterations:
            argv += ["--iters", str(options.iterations)]
            required = True
        spec = with_simulator_args(spec, argv)
    return replace(spec, output=output, required=required)


def _graph(options: LaunchOptions, console: Console) -> Graph:
    try:
        if options.wait:
            return _graph_of_others(options.port, console)
        return Graph.open(port=options.port, role="hub")
    except Exception as error:
        raise LaunchError(f"cannot open the graph: {error}") from error


def _graph_of_others(port: int | None, console: Console) -> Graph:
    """Join the graph as soon as somebody carries one."""
    pause, told = threading.Event(), False
    while True:
        try:
            graph = Graph.open(port=port, role="client")
        except NoGraphError:
            if not told:
                console.plain("roscore/master is not yet running, will wait for it to start")
            told = True
            pause.wait(_LOOK_AGAIN_S)
            continue
        if told:
            console.plain("master has started, initiating launch")
        return graph


def _set_params(config: LaunchConfig, graph: Graph, run_id: str) -> None:
    """Clear, delete, set and dump parameters, in roslaunch's order."""
    store = graph.parameters
    for name in [*config.clear_params, *config.deleted_params]:
        bare = name.rstrip("/") or "/"
        if store.has(bare):
            store.delete(bare)
    core = {name: value for name, value in _core_params().items() if not store.has(name)}
    for name, value in {**core, "/run_id": run_id, **config.params}.items():
        store.set(name, value)
    for dump in config.dumps:
        text = dump_yaml(store.get(dump.namespace))
        Path(dump.file).write_text(text, encoding="utf-8")


def _text_files(config: LaunchConfig, log_folder: Path) -> list[str]:
    """Return the files that hold the XML of parameters; what no file holds is written to one."""
    files = list(dict.fromkeys(config.text_files))
    for name, value in config.params.items():
        if not isinstance(value, str) or not value.lstrip().startswith("<"):
            continue
        if file_of_text(value, {TEXT_FILES_VARIABLE: os.pathsep.join(files)}) == TEXT_NAME:
            path = log_folder / copy_name(name)
            path.write_text(value, encoding="utf-8")
            files.append(str(path))
    return files


def _core_params() -> dict[str, Any]:
    return {"/rosdistro": "noetic\n", "/rosversion": "1.16.0\n"}


def _announce(graph: Graph, console: Console, title: str, log: RunLog) -> None:
    if sys.stdout.isatty():
        sys.stdout.write(f"\x1b]2;{title}\x07")
    console.bold(f"ROS_MASTER_URI=http://localhost:{graph.port}/")
    if log.is_new:
        console.bold(f"setting /run_id to {log.run_id}")


def _environ(options: LaunchOptions) -> Mapping[str, str]:
    # What it starts is ROS 1's, whichever ROS the shell was set up for.
    environ = {**os.environ, "ROS_VERSION": "1"}
    if options.port is not None:
        environ["GAZELLE_PORT"] = str(options.port)
    return environ


def _cwd(environ: Mapping[str, str]) -> Path:
    home = ros_home(environ)
    home.mkdir(parents=True, exist_ok=True)
    return home
