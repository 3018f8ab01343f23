"""Finding processes and texts as launch_testing does."""

from __future__ import annotations

import re
import threading
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.launch.ros2.actions import ExecuteProcess
from gazelle.launch.ros2.events.process import (
    ProcessExited,
    ProcessStarted,
    ProcessStderr,
    ProcessStdout,
)
from gazelle.launch.ros2.launch_testing import (
    ActiveIoHandler,
    ActiveProcInfoHandler,
    ReadyAggregator,
    asserts,
    proc_lookup,
    tools,
)
from gazelle.launch.ros2.launch_testing.output_text import build_line_match, build_text_match


@pytest.mark.parametrize(
    ("expected", "strict", "found"),
    [
        ("b", False, (2, 3)),
        ("b", True, None),
        ("a\nb\nc", True, (0, 5)),
        (re.compile("[bc]"), False, (2, 3)),
        (re.compile("b"), True, None),
        (["a", re.compile("c")], False, (0, 5)),
        (["c", "a"], False, None),
    ],
)
def test_texts(expected: Any, strict: bool, found: Any) -> None:
    assert build_text_match(expected, strict=strict)("a\r\nb\r\nc") == found


@pytest.mark.parametrize(
    ("expected", "strict", "found"),
    [
        ("b", False, (1, 2)),
        ("b", True, None),
        (re.compile("b+$"), False, (1, 2)),
        (["a", "c"], False, (0, 3)),
        (["a", "c"], True, None),
        (["a", "b", "c"], True, (0, 3)),
    ],
)
def test_lines(expected: Any, strict: bool, found: Any) -> None:
    assert build_line_match(expected, strict=strict)(["a", "bb", "c"]) == found


def test_expected_output(tmp_path: Path) -> None:
    coloured = "pid 3\n\x1b[32mready\x1b[0m\nrc 0\n"
    plain = tools.basic_output_filter()(coloured)
    assert tools.expect_output(plain, expected_text="ready\n", strict=True)
    assert tools.expect_output(lines=["a", "b"], expected_lines=["a", "b"], strict=True)
    assert not tools.expect_output(text="a", expected_lines=["b"])
    patterns = tools.basic_output_filter(filtered_prefixes=(), filtered_patterns=["^p"])
    assert patterns("pid\nx\n") == "x\n"
    with pytest.raises(ValueError, match="Either lines or text, but not both"):
        tools.expect_output("a", lines=["a"], expected_text="a")
    with pytest.raises(ValueError, match="Either expected lines or text, but not both"):
        tools.expect_output("a")
    (tmp_path / "a.txt").write_text("x\ny", encoding="utf-8")
    (tmp_path / "b.regex").write_text("x.", encoding="utf-8")
    assert tools.expected_output_from_file(str(tmp_path / "a")) == ["x", "y"]
    assert tools.expected_output_from_file(str(tmp_path / "b")) == [re.compile("x.")]
    with pytest.raises(RuntimeError, match="could not find output check file"):
        tools.expected_output_from_file(str(tmp_path / "c"))


def _process(name: str, *words: str) -> ExecuteProcess:
    action = ExecuteProcess(cmd=[name, *words])
    action.process_details = {"name": f"{name}-1", "cmd": [name, *words]}
    return action


def _event(kind: Any, action: ExecuteProcess, **more: Any) -> Any:
    details = action.process_details or {}
    given = {"name": details["name"], "cmd": details["cmd"], "cwd": None, "env": None, "pid": 1}
    return kind(action=action, **given, **more)


def test_processes_are_found_by_name_and_words() -> None:
    one, two, bare = _process("talk", "-a"), _process("talk", "-b"), _process("listen")
    known = SimpleNamespace(processes=lambda: [one, two, bare])
    assert proc_lookup.resolveProcesses(known) == [one, two, bare]
    assert proc_lookup.resolveProcesses(known, process=two) == [two]
    assert proc_lookup.resolveProcesses(known, process="talk", cmd_args="-b") == [two]
    assert proc_lookup.resolveProcesses(known, process="talk", strict_proc_matching=False) == [
        one,
        two,
    ]
    assert proc_lookup.resolveProcesses(
        known, process="listen", cmd_args=proc_lookup.NO_CMD_ARGS
    ) == [bare]
    none = proc_lookup.NoMatchingProcessException
    with pytest.raises(
        none, match=r"any processes matching name 'x' and args 'None'. Procs: listen"
    ):
        proc_lookup.resolveProcesses(known, process="x")
    with pytest.raises(none, match="No data recorded for proc other-1"):
        proc_lookup.resolveProcesses(known, process=_process("other"))
    with pytest.raises(none, match="No data recorded for any process"):
        proc_lookup.resolveProcesses(SimpleNamespace(processes=list))
    with pytest.raises(Exception, match="Found multiple processes matching name 'talk'"):
        proc_lookup.resolveProcesses(known, process="talk")
    with pytest.raises(TypeError, match="proc argument must be 'ExecuteProcess' or 'str'"):
        proc_lookup.resolveProcesses(known, process=3)


def test_output_is_waited_for_in_another_thread() -> None:
    output, talk = ActiveIoHandler(), _process("talk")
    later = threading.Timer(0.1, lambda: output.append(_event(ProcessStdout, talk, text=b"hello")))
    later.start()
    assert output.waitFor("hello", process="talk", stream="stdout", timeout=stretched())
    assert [one.text for one in output] == [b"hello"]
    assert (output.process_names(), output.processes()) == (["talk-1"], [talk])
    with pytest.raises(AssertionError, match="Waiting for output timed out"):
        output.assertWaitFor("bye", process=talk, stream="stdout", timeout=0.01)
    with pytest.raises(proc_lookup.NoMatchingProcessException):
        output.waitFor("bye", process="other", timeout=0.01)


def test_streams_are_told_apart() -> None:
    output, talk = ActiveIoHandler(), _process("talk")
    output.append(_event(ProcessStdout, talk, text=b"\x1b[1mout\x1b[0m put\n"))
    output.append(_event(ProcessStderr, talk, text=b"err\n"))
    asserts.assertInStdout(output, "out put", "talk")
    asserts.assertInStdout(output, "OUT", "talk", output_filter=str.upper)
    asserts.assertInStderr(output, re.compile("e(r+)"), talk)
    asserts.assertInStream(output, "err", talk, stream=asserts.assertDefaultStream())
    with pytest.raises(AssertionError, match="Did not find 'out' in output for any of the match"):
        asserts.assertInStderr(output, "out", talk)
    with pytest.raises(ValueError, match="must be 'stdout' or 'stderr'"):
        asserts.assertInStream(output, "x", talk, stream="log")
    with asserts.assertSequentialStdout(output, talk) as checker:
        checker.assertInText("put")
        with pytest.raises(AssertionError, match=r"'out' not found in sequence.*\n.*put\n *err"):
            checker.assertInText("out")


def test_ends_are_waited_for_in_another_thread() -> None:
    info, talk = ActiveProcInfoHandler(), _process("talk")
    with pytest.raises(AssertionError, match="Timed out waiting for process 'talk' to start"):
        info.assertWaitForStartup("talk", timeout=0.01)
    info.append(_event(ProcessStarted, talk))
    with pytest.raises(AssertionError, match="Timed out waiting for process 'talk' to finish"):
        info.assertWaitForShutdown("talk", timeout=0.01)
    threading.Timer(0.1, lambda: info.append(_event(ProcessExited, talk, returncode=3))).start()
    info.assertWaitForShutdown("talk", timeout=stretched())
    assert info["talk"].returncode == 3
    asserts.assertExitCodes(info, [3])
    with pytest.raises(AssertionError, match="Proc talk-1 exited with code 3"):
        asserts.assertExitCodes(info, process="talk")
    with pytest.raises(KeyError):
        info["other"]


def test_several_have_to_be_ready() -> None:
    told: list[int] = []
    together = ReadyAggregator(lambda: told.append(1), 2)
    together.ready_fn()
    assert told == []
    together.ready_fn()
    assert told == [1]
