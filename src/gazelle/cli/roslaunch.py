"""``roslaunch [options] [package] file.launch [arg:=value …]``."""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from pathlib import Path

from gazelle.cpp.lookup import CPP_VARIABLE
from gazelle.diagnostics import Diagnostics, did_you_mean, render
from gazelle.errors import NotFoundError
from gazelle.launch.console import dump_text
from gazelle.launch.launch_config import LaunchConfig, NodeTag
from gazelle.launch.node_commands import find_executable
from gazelle.launch.node_process import node_argv
from gazelle.launch.ros1.loader import load_launch_files, load_launch_text
from gazelle.launch.roslaunch import LaunchOptions, launch
from gazelle.launch.supervisor import StopTimes
from gazelle.workspace import Workspace

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Run roslaunch."""
    options = _parser().parse_args([word for word in argv if not _is_arg(word)])
    args = dict(word.split(":=", 1) for word in argv if _is_arg(word))
    if options.cpp:
        os.environ[CPP_VARIABLE] = "1"
    if options.core:
        from gazelle.cli import roscore

        return roscore.main(["-p", str(options.port)] if options.port else [])
    if not options.target:
        _parser().error("you must specify at least one input file")
    workspace, diagnostics = Workspace.discover(), Diagnostics()
    files = [] if options.target == ["-"] else _files(options.target, workspace)
    if files:
        config = load_launch_files(files, args, workspace=workspace, diagnostics=diagnostics)
    else:
        text = sys.stdin.read()
        config = load_launch_text(text, args, workspace=workspace, diagnostics=diagnostics)
    if options.ros_args:
        print(_args_text(config))
        return 0
    diagnostics.raise_if_errors()
    query = _query(options, config, workspace, diagnostics)
    if query is not None:
        render(diagnostics)
        return query
    title = str(files[0]) if files else "<stdin>"
    run = _launch_options(options)
    return launch(config, workspace=workspace, diagnostics=diagnostics, options=run, title=title)


def _is_arg(word: str) -> bool:
    return ":=" in word and not word.startswith("-")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="roslaunch",
        usage="roslaunch [options] [package] <filename> [arg_name:=value...]\n"
        "       roslaunch [options] <filename> [<filename>...] [arg_name:=value...]",
        epilog="If <filename> is a single dash ('-'), launch XML is read from standard input.",
    )
    add = parser.add_argument
    add("target", nargs="*", help=argparse.SUPPRESS)
    add("--files", action="store_true", help="print the files loaded")
    add("--args", metavar="NODE_NAME", help="print the command line of a node")
    add("--nodes", action="store_true", help="print the names of the nodes")
    add("--find-node", metavar="NODE_NAME", help="print the file that defines a node")
    add("--ros-args", action="store_true", help="print the arguments of the launch file")
    add("--dump-params", action="store_true", help="print the parameters as YAML")
    add("--screen", action="store_true", help="all output to the terminal")
    add("--log", action="store_true", help="all output to log files")
    add("--required", action="store_true", help="every node is required")
    add("--wait", action="store_true", help="wait for a graph instead of starting one")
    add("--local", action="store_true", help="accepted: nodes always run on this machine")
    add("--core", action="store_true", help="start the core only")
    add("-p", "--port", type=int, help="port of the graph")
    add("--pid", metavar="PID_FN", help="write this process's number to a file")
    add("-v", dest="verbose", action="store_true", help="print the files as they are read")
    add("--no-summary", action="store_true", help="do not print the summary")
    add("--run_id", default="", help="identifier of the run")
    add("--skip-log-check", action="store_true", help="accepted: logs are never checked")
    add("--disable-title", action="store_true", help="accepted: kept off where no terminal is")
    add("--sigint-timeout", type=float, default=15.0, help="seconds after SIGINT")
    add("--sigterm-timeout", type=float, default=2.0, help="seconds after SIGTERM")
    add("--cpp", action="store_true", help="take packages' C++ where Gazelle has nodes of its own")
    add("--no-bridge", action="store_true", help="do not join a real ROS that runs")
    add("--fast", action="store_true", help="simulate as fast as possible")
    add(
        "--lockstep",
        action="store_true",
        help="every run the same: time waits for spawners, frames",
    )
    add("--iters", type=int, default=0, metavar="N", help="end after N steps of the simulator")
    add("--seed", type=int, default=0, metavar="N", help="seed of the simulator's noise")
    return parser


def _files(target: list[str], workspace: Workspace) -> list[Path]:
    """Return the launch files meant: files as they are, or a package and a name in it."""
    paths = [Path(word) for word in target]
    if len(target) == 2 and not paths[0].is_file():
        return [_in_package(target[0], target[1], workspace)]
    for path in paths:
        if not path.is_file():
            hint = "" if path.parent.name else "in a package? roslaunch PACKAGE FILE"
            raise NotFoundError("launch file", str(path), searched=[str(Path.cwd())], hint=hint)
    return [path.resolve() for path in paths]


def _in_package(name: str, file: str, workspace: Workspace) -> Path:
    package = workspace.package(name)
    found = sorted(package.path.rglob(file))
    if found:
        return found[0]
    existing = sorted({path.name for path in package.path.rglob("*.launch")})
    there = f"launch files there: {', '.join(existing) or 'none'}"
    raise NotFoundError(
        "launch file",
        file,
        searched=[str(package.path)],
        nearest=[item for item in existing if did_you_mean(file, [item])],
        hint="\n  ".join(filter(None, (there, package.note_on_files))),
    )


def _launch_options(options: argparse.Namespace) -> LaunchOptions:
    if options.pid:
        Path(options.pid).write_text(f"{os.getpid()}\n", encoding="utf-8")
    simulator_args = [word for word in ("--fast", "--lockstep") if getattr(options, word[2:])]
    simulator_args += ["--seed", str(options.seed)] if options.seed else []
    return LaunchOptions(
        screen=options.screen,
        log=options.log,
        required=options.required,
        wait=options.wait,
        port=options.port,
        show_summary=not options.no_summary,
        run_id=options.run_id,
        simulator_args=tuple(simulator_args),
        lockstep=options.lockstep,
        iterations=options.iters,
        bridge=not options.no_bridge,
        stop_times=StopTimes(options.sigint_timeout, options.sigterm_timeout),
    )


def _query(
    options: argparse.Namespace,
    config: LaunchConfig,
    workspace: Workspace,
    diagnostics: Diagnostics,
) -> int | None:
    """Answer the options that only print; None when the launch is to start."""
    if options.files:
        print("\n".join(dict.fromkeys(config.files)))
    elif options.nodes:
        print("\n".join(node.full_name for node in _all_nodes(config)))
    elif options.dump_params:
        print(dump_text(config))
    elif options.find_node:
        print(config.node_files[_node(options.find_node, config).full_name])
    elif options.args:
        print(_command_line(_node(options.args, config), workspace, diagnostics))
    else:
        return None
    return 0


def _all_nodes(config: LaunchConfig) -> list[NodeTag]:
    return [*config.nodes, *(test.node for test in config.tests)]


def _node(name: str, config: LaunchConfig) -> NodeTag:
    full = name if name.startswith("/") else f"/{name}"
    by_name = {node.full_name: node for node in _all_nodes(config)}
    if full not in by_name:
        raise NotFoundError("node", full, nearest=sorted(by_name))
    return by_name[full]


def _command_line(spec: NodeTag, workspace: Workspace, diagnostics: Diagnostics) -> str:
    executable = find_executable(
        spec.package, spec.type, workspace=workspace, diagnostics=diagnostics, span=spec.span
    )
    diagnostics.raise_if_errors()
    assert executable is not None
    namespace = spec.namespace.rstrip("/") or "/"
    environment = [f'ROS_NAMESPACE="{namespace}"', *(f'{key}="{value}"' for key, value in spec.env)]
    prefix = shlex.split(spec.launch_prefix)
    return " ".join([*environment, *prefix, *executable.command, *node_argv(spec)])


def _args_text(config: LaunchConfig) -> str:
    """Return the arguments of the top-level file as ``roslaunch --ros-args`` prints them."""
    required, optional = [], []
    for item in sorted(config.args, key=lambda arg: arg.name):
        doc = item.doc or "undocumented"
        if item.default is not None:
            optional.append(f'  {item.name} (default "{item.default}"): {doc}')
        elif item.value is None:
            required.append(f"  {item.name}: {doc}")
    lines = ["Required Arguments:", *required] if required else []
    lines += ["Optional Arguments:", *optional] if optional else []
    return "\n".join(lines)
