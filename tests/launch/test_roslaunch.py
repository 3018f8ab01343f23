"""The roslaunch command: its options, its questions, its printed blocks."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from tests.launch.conftest import node as written_node
from tests.launch.conftest import write_package

from gazelle.graph import Graph

Run = Callable[..., Any]


@dataclass
class _Ended:
    """A launch that has ended, and the folder with what it left."""

    run: Any
    folder: Path


@pytest.fixture(scope="module")
def ended(module_gazelle: Run, tmp_path_factory: pytest.TempPathFactory) -> _Ended:
    """One launch for all that look at what it said and wrote."""
    folder = tmp_path_factory.mktemp("ended")
    write_package(folder)
    body = '<param name="k" value="2.5"/><param name="long" value="abcdefghijklmnopqrstuvwxyz"/>'
    body += written_node("b") + written_node("a", ns="deep")
    file = folder / "test.launch"
    file.write_text(f"<launch>{body}</launch>", encoding="utf-8")
    words = (f"--pid={folder / 'launch.pid'}", "--run_id=my_run", str(file))
    run = module_gazelle("roslaunch", *words, cwd=folder, ROS_HOME=str(folder / "ros_home"))
    assert run.wait() == 0
    return _Ended(run, folder)


def test_summary_lists_parameters_and_nodes_by_namespace(ended: _Ended) -> None:
    run = ended.run
    start = run.lines.index("SUMMARY")
    end = next(i for i, line in enumerate(run.lines) if line.startswith("ROS_MASTER_URI="))
    assert run.lines[start:end] == [
        "SUMMARY", "========", "", "PARAMETERS", " * /k: 2.5", " * /long: abcdefghijklmnopq...",
        " * /rosdistro: noetic ", " * /rosversion: 1.16.0 ", "", "NODES", "  /",
        "    b (tests_pkg/does)", "  /deep/", "    a (tests_pkg/does)", "",
    ]  # fmt: skip


def test_several_files_are_one_launch(gazelle: Run, package: Path, tmp_path: Path) -> None:
    files = []
    for name in ("one", "two"):
        file = tmp_path / f"{name}.launch"
        file.write_text(
            f'<launch><node pkg="tests_pkg" type="does" name="{name}" args="say={name}"'
            ' output="screen"/></launch>',
            encoding="utf-8",
        )
        files.append(str(file))
    run = gazelle("roslaunch", *files)
    assert run.wait() == 0
    # Two processes write at once: their words may stand on one line.
    assert "one" in run.text and "two" in run.text


def test_dash_reads_standard_input(gazelle: Run, package: Path) -> None:
    text = (
        '<launch><node pkg="tests_pkg" type="does" name="n" args="say=piped" output="screen"/>'
        "</launch>"
    )
    run = gazelle("roslaunch", "-", stdin=subprocess.PIPE)
    assert run.popen.stdin is not None
    run.popen.stdin.write(text)
    run.popen.stdin.close()
    assert run.wait() == 0
    assert "piped" in run.lines


def test_pid_option_writes_the_launchers_number(ended: _Ended) -> None:
    written = (ended.folder / "launch.pid").read_text(encoding="utf-8")
    assert int(written) == ended.run.popen.pid


def test_wait_option_joins_the_graph_that_comes(launch: Run, node: Run, free_port: int) -> None:
    run = launch(node("n", "say=joined", output="screen"), "--wait")
    run.wait_for_line("roscore/master is not yet running, will wait for it to start")
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        assert run.wait() == 0
        assert graph.is_hub
        assert graph.parameters.has("/run_id")
    assert {"master has started, initiating launch", "joined"} <= set(run.lines)


def test_roscore_carries_the_graph_until_it_is_told_to_end(gazelle: Run) -> None:
    core = gazelle("roscore")
    core.wait_for_line(r"started core service \[/rosout\]")
    core.eventually(lambda: "/rosout" in core.graph.node_names())
    assert core.graph.parameters.get("/rosdistro") == "noetic\n"
    assert core.stop() == 0
    assert core.processes() == {}


@pytest.mark.parametrize(
    ("option", "expected"),
    [
        (("--nodes",), ["/deep/n"]),
        (("--args", "/deep/n"), None),
        (("--dump-params",), ["/deep/n/rate: 5"]),
        (("--ros-args",), ["Optional Arguments:", '  speed (default "1"): how fast']),
    ],
)
def test_questions_are_answered_and_nothing_starts(
    gazelle: Run, package: Path, tmp_path: Path, option: tuple[str, ...], expected: list[str] | None
) -> None:
    (package / "q.launch").write_text(
        '<launch><arg name="speed" default="1" doc="how fast"/>'
        '<node pkg="tests_pkg" type="does" name="n" ns="deep" args="$(arg speed)">'
        '<param name="rate" value="5"/><remap from="a" to="b"/></node></launch>',
        encoding="utf-8",
    )
    run = gazelle("roslaunch", *option, "tests_pkg", "q.launch", "speed:=3", cwd=tmp_path)
    assert run.wait() == 0, run.text
    assert "started with pid" not in run.text
    if expected is not None:
        assert [line for line in run.lines if line] == expected
    else:
        (line,) = run.lines
        assert re.match(r'ROS_NAMESPACE="/deep" .*scripts/does 3 a:=b __name:=n$', line)


def test_second_launch_joins_the_first_ones_graph(launch: Run, node: Run, gazelle: Run) -> None:
    first = launch('<param name="from_first" value="1"/>' + node("a", "node=a"))
    first.eventually(lambda: "/a" in first.graph.node_names())
    second = launch(node("b", "node=b"))
    first.eventually(lambda: {"/a", "/b"} <= set(first.graph.node_names()))
    assert second.stop() == 0
    assert first.graph.parameters.get("/from_first") == 1
    assert first.popen.poll() is None
    assert first.stop() == 0


def test_latest_points_at_the_newest_run(ended: _Ended) -> None:
    latest = ended.folder / "ros_home" / "log" / "latest"
    assert latest.readlink().name == "my_run"
    assert (latest / "rosout.log").is_file()


@pytest.mark.parametrize("words", [("--wait",), ("--screen",)])
def test_launch_of_parameters_alone_ends_where_somebody_else_carries_the_graph(
    gazelle: Run, tmp_path: Path, free_port: int, words: tuple[str, ...]
) -> None:
    file = tmp_path / "noop.launch"
    file.write_text('<launch><param name="noop" value="noop"/></launch>', encoding="utf-8")
    with Graph.open(port=free_port, role="hub") as graph:
        run = gazelle("roslaunch", *words, str(file))
        assert run.wait() == 0
        assert "No processes to monitor" in run.lines
        assert graph.parameters.get("/noop") == "noop"
