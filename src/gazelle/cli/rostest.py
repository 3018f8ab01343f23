"""``rostest [PACKAGE] FILE.test [arg:=value …]``: runs the ``<test>`` nodes of a launch file."""

from __future__ import annotations

import argparse
import os
import shlex
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple, Self

from gazelle.compat.rostest import xml_text
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics
from gazelle.errors import NotFoundError
from gazelle.graph import Graph
from gazelle.launch.cpp_nodes import compiled_ahead
from gazelle.launch.environment import node_environment
from gazelle.launch.launch_config import LaunchConfig, TestTag
from gazelle.launch.node_commands import find_executable
from gazelle.launch.node_process import node_argv
from gazelle.launch.ros1.loader import load_launch_files
from gazelle.process_lifetime import PARENT_VARIABLE
from gazelle.user_folders import ros_home
from gazelle.workspace import Workspace

__all__ = ["Case", "main", "read_cases", "write_suite"]

_RULE = "[ROSTEST]" + "-" * 71
_STATE_RULE = 26
_PROBLEMS = ("failure", "error")
_SET = "setting /run_id"
_PATIENCE_S = 20.0


class Case(NamedTuple):
    """One test method, as JUnit XML has it; `problem` is empty, ``failure`` or ``error``."""

    classname: str
    name: str
    seconds: float = 0.0
    problem: str = ""
    kind: str = ""
    text: str = ""

    @property
    def passed(self) -> bool:
        """Whether it passed."""
        return not self.problem


class _TestRun:
    """A graph of its own on a free port, with the launch's nodes; ends with the ``with`` block."""

    __test__ = False

    def __init__(
        self, file: Path, args: Mapping[str, str], *, has_nodes: bool, workspace: Workspace
    ) -> None:
        """Take over what to start; `has_nodes` says that there is more than tests."""
        self._argv = [str(file), *(f"{name}:={value}" for name, value in args.items())]
        self._has_nodes = has_nodes
        self._workspace = workspace
        self._port = _free_port()
        self._launch: subprocess.Popen[str] | None = None
        environ = {**os.environ, "GAZELLE_PORT": str(self._port)}
        self._environment = node_environment(environ, workspace)

    def __enter__(self) -> Self:
        self._graph = Graph.open(port=self._port, role="hub")
        return self

    def __exit__(self, *exc_info: object) -> None:
        if self._launch is not None:
            self._launch.send_signal(signal.SIGINT)
            _end(self._launch)
        self._graph.close()

    def set_parameters(self, config: LaunchConfig) -> None:
        """Set the launch's parameters and start its nodes."""
        for name, value in config.params.items():
            self._graph.parameters.set(name, value)
        if self._has_nodes:
            self._start_nodes()

    def tried(self, test: TestTag, result: Path, *, show: bool) -> list[Case]:
        """Run a test, again as often as its ``retry`` says; return its cases.

        Args:
            test: which.
            result: the file that it shall write.
            show: its output goes to the terminal.
        """
        diagnostics = Diagnostics()
        node = test.node
        found = find_executable(
            node.package,
            node.type,
            workspace=self._workspace,
            diagnostics=diagnostics,
            span=node.span,
        )
        (found,) = compiled_ahead([found], workspace=self._workspace, diagnostics=diagnostics)
        if found is None:
            why = "; ".join(item.message for item in diagnostics)
            return [_missing_result(test.test_name, f"Test node cannot be found: {why}")]
        own = [*node_argv(node), f"--gtest_output=xml:{result}"]
        command = [*shlex.split(node.launch_prefix), *found.command, *own]
        cases: list[Case] = []
        for _ in range(test.retry + 1):
            cases = self._run(command, test, result, show=show)
            if all(one.passed for one in cases):
                break
        return cases

    def _run(self, argv: list[str], test: TestTag, result: Path, *, show: bool) -> list[Case]:
        result.parent.mkdir(parents=True, exist_ok=True)
        result.unlink(missing_ok=True)
        namespace = test.node.namespace.rstrip("/") or "/"
        environment = {
            **self._environment,
            **dict(test.node.env),
            "ROS_NAMESPACE": namespace,
            PARENT_VARIABLE: str(os.getpid()),
        }
        output = None if show else subprocess.PIPE
        process = subprocess.Popen(
            argv,
            env=environment,
            cwd=_home(),
            stdout=output,
            stderr=None if show else subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        )
        try:
            said, _ = process.communicate(timeout=test.time_limit_s)
        except subprocess.TimeoutExpired:
            _end(process)
            text = f"Test time limit of {test.time_limit_s:g} s exceeded: [{test.test_name}]"
            return [_missing_result(test.test_name, text)]
        if not result.is_file():
            text = f"Test node [{test.node.package}/{test.node.type}] did not generate test results"
            text += f" (exit code {process.returncode})\n{said or ''}"
            return [_missing_result(test.test_name, text)]
        return read_cases(result)

    def _start_nodes(self) -> None:
        """Start ``roslaunch`` beside, and wait until it has set its parameters."""
        command = [sys.executable, "-m", "gazelle.cli", "roslaunch", "--no-summary", *self._argv]
        self._launch = subprocess.Popen(
            command, env=self._environment, stdout=subprocess.PIPE, text=True, errors="replace"
        )
        ready = threading.Event()
        threading.Thread(target=_pump, args=(self._launch, ready), daemon=True).start()
        ready.wait(_PATIENCE_S)


def main(argv: list[str]) -> int:
    """Run the tests.

    Returns:
        0 when all passed, 1 when one did not, 2 for wrong usage.
    """
    try:
        options = _parser().parse_args([word for word in argv if not _is_arg(word)])
    except SystemExit as stop:
        return int(stop.code or 0)
    workspace, diagnostics = Workspace.discover(), Diagnostics()
    file = _file(options.target, workspace)
    args = dict(word.split(":=", 1) for word in argv if _is_arg(word))
    config = load_launch_files([file], args, workspace=workspace, diagnostics=diagnostics)
    diagnostics.raise_if_errors()
    package = options.pkgdir or _package_of(file, workspace)
    if not config.tests:
        print(f"rostest: '{file}' has no <test>; roslaunch runs it")
        return 1
    folder = Path(options.results_base_dir or ros_home(os.environ) / "test_results") / package
    cases = _run(config, file, args, folder=folder, workspace=workspace, text=options.text)
    name = options.results_filename or f"rostest-{file.stem}.xml"
    print(f"[ROSTEST] Outputting test results to {folder / name}")
    write_suite(folder / name, f"rostest.{file.stem}", cases)
    return _print_summary(package, cases)


def read_cases(file: Path) -> list[Case]:
    """Return the cases of a file; one error when it cannot be read."""
    diagnostics = Diagnostics()
    root = read_xml(file, diagnostics)
    if root is None:
        why = "; ".join(item.message for item in diagnostics)
        return [_missing_result(file.stem, f"the results cannot be read: {why}")]
    suites = [root] if root.name == "testsuite" else list(root.children)
    return [_case(tag) for suite in suites for tag in suite.children if tag.name == "testcase"]


def write_suite(file: Path, name: str, cases: Sequence[Case]) -> None:
    """Write all cases into one file."""
    file.parent.mkdir(parents=True, exist_ok=True)
    total_s = sum(one.seconds for one in cases)
    file.write_text(xml_text(name, cases, total_s), encoding="utf-8")


def _missing_result(test_name: str, text: str) -> Case:
    """Return the case of a test that left no results."""
    return Case("rostest.runner", test_name, problem="error", kind="Error", text=text)


def _print_summary(package: str, cases: Sequence[Case]) -> int:
    """Print every case and the sums; return the exit code."""
    errors = sum(one.problem == "error" for one in cases)
    failures = sum(one.problem == "failure" for one in cases)
    print(f"\n{_RULE}\n")
    for one in cases:
        state = {"": "passed", "failure": "FAILURE", "error": "ERROR"}[one.problem]
        rule = "-" * _STATE_RULE if one.problem else ""
        print(f"[{package}.{one.classname}/{one.name}][{state}]{rule}")
        if one.problem:
            print(one.text.rstrip("\n"))
            print("-" * 80 + "\n")
    result = "FAIL" if errors or failures else "SUCCESS"
    print(f"\nSUMMARY\n * RESULT: {result}\n * TESTS: {len(cases)}")
    print(f" * ERRORS: {errors}\n * FAILURES: {failures}\n")
    return 1 if errors or failures else 0


def _case(tag: Tag) -> Case:
    attributes = tag.attributes
    bad = next((child for child in tag.children if child.name in _PROBLEMS), None)
    try:
        seconds = float(attributes.get("time", "0"))
    except ValueError:
        seconds = 0.0
    case = Case(attributes.get("classname", ""), attributes.get("name", ""), seconds)
    if bad is None:
        return case
    text = bad.text or bad.attributes.get("message", "")
    return case._replace(problem=bad.name, kind=bad.attributes.get("type", ""), text=text)


def _pump(process: subprocess.Popen[str], ready: threading.Event) -> None:
    """Read what roslaunch prints; it goes on to the terminal's standard error."""
    assert process.stdout is not None
    for line in process.stdout:
        if _SET in line:
            ready.set()
        print(line, end="", file=sys.stderr, flush=True)
    ready.set()


def _end(process: subprocess.Popen[str]) -> None:
    """Wait for a process, and kill it when it does not end."""
    try:
        if process.poll() is None and os.getpgid(process.pid) == process.pid:
            os.killpg(process.pid, signal.SIGTERM)
        process.wait(_PATIENCE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _home() -> Path:
    home = ros_home(os.environ)
    home.mkdir(parents=True, exist_ok=True)
    return home


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _run(
    config: LaunchConfig,
    file: Path,
    args: dict[str, str],
    *,
    folder: Path,
    workspace: Workspace,
    text: bool,
) -> list[Case]:
    cases: list[Case] = []
    for test in config.tests:
        result = folder / f"rosunit-{test.test_name}.xml"
        with _TestRun(file, args, has_nodes=bool(config.nodes), workspace=workspace) as run:
            run.set_parameters(config)
            found = run.tried(test, result, show=text)
        cases += found
        state = "ok" if all(one.passed for one in found) else "FAILURE!"
        print(f"[Testcase: test{test.test_name}] ... {state}", flush=True)
    return cases


def _is_arg(word: str) -> bool:
    return ":=" in word and not word.startswith("-")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="rostest", usage="rostest [options] [package] <filename> [arg_name:=value...]"
    )
    add = parser.add_argument
    add("target", nargs="+", help=argparse.SUPPRESS)
    add("-t", "--text", action="store_true", help="output of the tests to the terminal")
    add("--pkgdir", metavar="NAME", help="package that the results belong to")
    add("--results-filename", metavar="NAME", help="results_filename")
    add("--results-base-dir", metavar="DIR", help="the folder of all results")
    return parser


def _file(target: list[str], workspace: Workspace) -> Path:
    if len(target) == 1 and Path(target[0]).is_file():
        return Path(target[0]).resolve()
    if len(target) != 2:
        raise NotFoundError("test file", target[0], searched=[str(Path.cwd())])
    package = workspace.package(target[0])
    found = sorted(package.path.rglob(target[1]))
    if not found:
        names = sorted({path.name for path in package.path.rglob("*.test")})
        hint = f"test files there: {', '.join(names) or 'none'}"
        raise NotFoundError("test file", target[1], searched=[str(package.path)], hint=hint)
    return found[0]


def _package_of(file: Path, workspace: Workspace) -> str:
    roots = {item.path.resolve(): item.name for item in workspace.packages.values()}
    return next((roots[one] for one in file.parents if one in roots), "no_package")
