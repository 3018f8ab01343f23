"""view_frames and tf_monitor."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from gazelle.cli import tf_monitor, view_frames
from gazelle.cli.tf_monitor import FrameDelays, NetDelay
from gazelle.diagnostics import Diagnostics
from gazelle.graph import Node
from gazelle.interfaces import message_type
from gazelle.launch.node_commands import find_executable
from gazelle.workspace import Workspace

_STAMP_S = 1000


def _message(*links: tuple[str, str]) -> Any:
    made = message_type("tf2_msgs/TFMessage")()
    for parent, child in links:
        one = message_type("geometry_msgs/TransformStamped")()
        one.header.frame_id, one.child_frame_id = parent, child
        one.header.stamp.sec, one.transform.rotation.w = _STAMP_S, 1.0
        made.transforms = [*made.transforms, one]
    return made


@pytest.fixture
def tree(robot: Node) -> None:
    moving = _message(("base_link", "laser"), ("base_link", "left_wheel"))
    robot.create_publisher("/tf", "tf2_msgs/TFMessage", latch=True).publish(moving)
    fixed = robot.create_publisher("/tf_static", "tf2_msgs/TFMessage", latch=True)
    fixed.publish(_message(("laser", "laser_tip")))


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder, where a ``dot`` copies its input."""
    monkeypatch.chdir(tmp_path)
    dot = tmp_path / "dot"
    dot.write_text('#!/bin/sh\n/bin/cp "$2" "$4"\n', encoding="utf-8")
    dot.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    return tmp_path


def test_frames_are_drawn_as_ros_draws_them(tree: None, here: Path, capsys: Any) -> None:
    assert view_frames.main(["--wait-time", "0.3"]) == 0
    out = capsys.readouterr().out
    assert out == "Listening to /tf for 0.3 seconds\nDone Listening\nframes.pdf generated\n"
    text = (here / "frames.gv").read_text(encoding="utf-8")
    assert text == (here / "frames.pdf").read_text(encoding="utf-8")
    assert '"laser" -> "laser_tip"[label=" Broadcaster: /robot\\nAverage rate: 10000.0' in text
    assert '"base_link" -> "left_wheel"' in text
    assert 'label ="view_frames Result"' in text


def test_tf2_logs_what_it_does(tree: None, here: Path, capsys: Any, recorded: Any) -> None:
    assert view_frames.main(["--tf2", "--wait-time", "0.2"]) == 0
    shape = re.compile(r"\d+\.\d{6}")
    wanted = shape.sub("T", recorded("view_frames2").out).replace("5 s", "0.2 s")
    assert shape.sub("T", capsys.readouterr().out) == wanted


def test_without_dot_the_drawing_is_still_there(tree: None, here: Path, capsys: Any) -> None:
    (here / "dot").unlink()
    assert view_frames.main(["--wait-time", "0.2"]) == 1
    assert (here / "frames.gv").is_file()
    assert "view_frames: 'frames.pdf' was not made: the program 'dot'" in capsys.readouterr().err


def test_chain_is_watched_in_the_words_of_ros(tree: None, run_until: Any, recorded: Any) -> None:
    out = run_until("Node: /robot(static)", "tf_monitor", "base_link", "/laser_tip")
    wanted = recorded("tf_monitor").out
    names = wanted.replace("unknown_publisher", "/robot")
    number = re.compile(r"\d[\d.e+]*")
    block = number.sub("N", "".join(names.splitlines(keepends=True)[:13]))
    assert number.sub("N", out).startswith(block)


def test_all_frames_without_arguments() -> None:
    delays = FrameDelays()
    for now_s in (1000.1, 1000.2, 1000.4):
        delays.add(_message(("a", "c"), ("a", "b")), "/robot", now_s, is_static=False)
    delays.add(_message(("b", "tip")), "/fixed", 1000.0, is_static=True)
    results, title, nodes = tf_monitor.report(delays, [], NetDelay())
    assert results.splitlines()[3:] == [
        "RESULTS: for all Frames",
        "",
        "Frames:",
        "Frame: b published by /robot Average Delay: 0.233333 Max Delay: 0.4",
        "Frame: c published by /robot Average Delay: 0.233333 Max Delay: 0.4",
        "Frame: tip published by /fixed(static) Average Delay: 0 Max Delay: 0",
    ]
    assert title == "\nAll Broadcasters:"
    assert nodes.splitlines() == [
        "Node: /fixed(static) 1e+08 Hz, Average Delay: 0 Max Delay: 0",
        "Node: /robot 10 Hz, Average Delay: 0.233333 Max Delay: 0.4",
    ]


def test_net_delay_is_smoothed_as_in_the_recording() -> None:
    net = NetDelay()
    for _ in range(20):
        net.add(0.0524)
    assert net.average_s == pytest.approx(0.00952835, rel=0.01)


def test_wrong_arguments_print_the_usage(capsys: Any) -> None:
    assert tf_monitor.main(["base_link"]) == 255
    assert capsys.readouterr().err.startswith("TF_Monitor: usage\n")


@pytest.mark.parametrize(
    ("package", "name", "words"),
    [
        ("tf", "view_frames", ("view_frames",)),
        ("tf2_tools", "view_frames.py", ("view_frames", "--tf2")),
        ("tf2_tools", "view_frames", ("view_frames", "--tf2")),
        ("tf", "tf_monitor", ("tf_monitor",)),
        ("tf2_ros", "tf2_monitor", ("tf_monitor",)),
    ],
)
def test_packages_have_them_as_executables(package: str, name: str, words: Any) -> None:
    workspace = Workspace.discover(environ={}, cwd=Path("/"))
    found = find_executable(package, name, workspace=workspace, diagnostics=Diagnostics())
    assert found is not None
    assert found.command[-len(words) :] == words
