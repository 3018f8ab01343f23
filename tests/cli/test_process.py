"""The commands as processes: start, pipes, Ctrl-C, exit codes."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest
from tests.patience import stretched

from gazelle.graph import Graph, Node
from gazelle.interfaces import ros1_message_type

_GAZELLE = [sys.executable, "-m", "gazelle.cli"]
# What a script's `command &` does to a command: SIGINT is ignored.
_IN_THE_BACKGROUND = ["/bin/sh", "-c", 'trap "" INT; exec "$@"', "sh"]


@pytest.mark.parametrize("started", [[], _IN_THE_BACKGROUND], ids=["shell", "background"])
def test_hz_ends_with_ctrl_c_and_no_traceback(robot: Node, pump, started: list[str]) -> None:
    kind = ros1_message_type("std_msgs/String")
    publisher = robot.create_publisher("/chat", kind)
    pump(lambda: publisher.publish(kind()))
    words = [*started, *_GAZELLE, "rostopic", "hz", "/chat"]
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "subscribed to [/chat]\n"
        assert process.stdout.readline().startswith("average rate: ")
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=stretched())
    assert (process.returncode, err) == (0, "")


@pytest.mark.skipif(os.name == "nt", reason="head is not there")
def test_echo_ends_when_its_reader_goes(robot: Node, pump) -> None:
    kind = ros1_message_type("std_msgs/String")
    publisher = robot.create_publisher("/chat", kind)
    pump(lambda: publisher.publish(kind(data="hi")))
    command = f"{sys.executable} -m gazelle.cli rostopic echo /chat | head -n 1"
    found = subprocess.run(
        ["/bin/sh", "-c", command], capture_output=True, text=True, timeout=stretched(), check=True
    )
    assert (found.stdout, found.stderr) == ('data: "hi"\n', "")


@pytest.mark.skipif(os.name == "nt", reason="needs a pipe that can break")
@pytest.mark.parametrize(
    "words",
    [
        ["--help"],
        ["--version"],
        ["nonsense"],
        ["rostopic"],
        ["rosbag", "--help"],
        ["ros2", "--help"],
        ["ros2", "topic", "--help"],
        ["gz", "--help"],
        ["roslaunch", "--help"],
        ["gzserver", "--help"],
        ["doctor", "--help"],
    ],
    ids=" ".join,
)
@pytest.mark.parametrize("unbuffered", ["", "1"], ids=["buffered", "unbuffered"])
def test_a_reader_that_has_gone_is_no_error(words: list[str], unbuffered: str) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    found = subprocess.run(
        [*_GAZELLE, *words],
        stdout=writer,
        stderr=subprocess.PIPE,
        text=True,
        timeout=stretched(),
        check=False,
        env={**os.environ, "PYTHONUNBUFFERED": unbuffered},
    )
    os.close(writer)
    assert "Traceback" not in found.stderr
    assert "BrokenPipeError" not in found.stderr
    # 255 is what `gz --help` ends with in any case.
    assert found.returncode in (0, 1, 2, 64, 255)


def test_unknown_topic_is_exit_code_1(graph: Graph) -> None:
    words = [*_GAZELLE, "rostopic", "info", "/nothing"]
    found = subprocess.run(words, capture_output=True, text=True, timeout=stretched(), check=False)
    assert (found.returncode, found.stderr) == (1, "ERROR: Unknown topic /nothing\n")


def test_commands_start_without_the_heavy_modules(graph: Graph) -> None:
    heavy = ("embreex", "llvmlite", "mujoco", "rich", "scipy")
    text = (
        "import sys; from gazelle.cli.main import main; "
        "code = main(['rostopic', 'list']); "
        f"print(code, [name for name in {heavy!r} if name in sys.modules])"
    )
    words = [sys.executable, "-c", text]
    found = subprocess.run(words, capture_output=True, text=True, timeout=stretched(), check=True)
    assert found.stdout.splitlines()[-1] == "0 []"
