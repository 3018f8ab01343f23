"""Processes of a launch: output, respawn, signals, and what is left of them."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import psutil
import pytest
from tests.patience import PATIENCE_S, at_most, eventually
from tests.processes import is_gone

from gazelle.launch.ros2 import LaunchDescription, LaunchService, child_process, logging
from gazelle.launch.ros2 import actions as a
from gazelle.launch.ros2.event_handlers import OnProcessIO
from gazelle.launch.ros2.events import process as process_events
from gazelle.launch.ros2.substitutions import LaunchConfiguration

Run = Callable[..., Any]
_SOON_S = 0.3
_BOTH = ["sh", "-c", "echo out; echo err >&2"]
_STUBBORN = (
    "import signal, time\nfor n in {signals}: signal.signal(n, signal.SIG_IGN)\n"
    "print('ready', flush=True)\ntime.sleep(60)"
)


def _log(name: str) -> str:
    path = Path(logging.launch_config.get_log_file_path(name))
    return path.read_text(encoding="utf-8") if path.exists() else ""


@pytest.mark.parametrize(
    ("output", "screen", "log", "own"),
    [
        ("screen", "out err", "", {}),
        ("log", "err", "out err", {}),
        ("both", "out err", "out err", {}),
        ("own_log", "", "", {"": "out err", "-stdout": "out", "-stderr": "err"}),
        ("full", "out err", "out err", {"": "out err", "-stdout": "out", "-stderr": "err"}),
        ({"stdout": "screen", "stderr": {"log"}}, "out", "err", {}),
    ],
)
def test_output_goes_where_its_mode_says(
    run: Run, output: Any, screen: str, log: str, own: dict[str, str]
) -> None:
    process = a.ExecuteProcess(cmd=_BOTH, name="p", output=output)
    ran = run(process)
    shown = [line for line in ran.lines if line.startswith(f"[{process.name}] ")]
    words = [f"[{process.name}] {word}" for word in screen.split()]
    assert sorted(shown) == sorted(words)
    logged = [f" [{process.name}] {word}\n" for word in ("out", "err")]
    assert [text in _log("launch.log") for text in logged] == [w in log for w in ("out", "err")]
    for end in ("", "-stdout", "-stderr"):
        lines = sorted(_log(f"{process.name}{end}.log").split("\n"))
        expected = [f"[{process.name}] {word}" for word in own.get(end, "").split()]
        assert lines == sorted([*expected, ""])


def test_unknown_output_modes_are_refused(run: Run) -> None:
    ran = run(a.ExecuteProcess(cmd=["true"], output="sreen"))
    assert ran.code == 1
    assert "sreen is not a valid standard output config" in ran.text
    with pytest.raises(ValueError, match="is not a valid output destination"):
        logging.get_output_loggers("p", {"stdout": "disk"})
    with pytest.raises(ValueError, match="is not a valid output source"):
        logging.get_output_loggers("p", {"stdin": "log"})


def test_the_environment_overrides_output_and_format(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OVERRIDE_LAUNCH_PROCESS_OUTPUT", "screen")
    monkeypatch.setenv("OVERRIDE_LAUNCH_SCREEN_FORMAT", "{name}>{msg}")
    logging.reset()
    process = a.ExecuteProcess(cmd=["echo", "a"], output_format="{line}!")
    assert {"a!", "launch.user>b"} <= set(run(process, a.LogInfo(msg="b")).lines)


def test_output_is_cut_into_lines_and_wrong_bytes_are_shown(run: Run) -> None:
    code = r"printf 'a\r\nb'; printf '\303'; printf '\244\377c\n'; printf 'end'"
    process = a.ExecuteProcess(cmd=["sh", "-c", code], output="screen")
    shown = [x for x in run(process).lines if x.startswith(f"[{process.name}]")]
    assert shown == [f"[{process.name}] {text}" for text in ("a", "b\u00e4\ufffdc", "end")]


def test_a_terminal_is_emulated_when_asked_for(run: Run) -> None:
    code = "import sys; print(sys.stdout.isatty(), sys.stderr.isatty())"
    plain, tty = (
        a.ExecuteProcess(cmd=[sys.executable, "-c", code], cached_output=True, emulate_tty=value)
        for value in (False, True)
    )
    run(plain, tty)
    assert (plain.get_stdout(), tty.get_stdout()) == ("False False\n", "True True\n")
    asked = a.ExecuteProcess(cmd=[sys.executable, "-c", code], cached_output=True)
    run(asked, emulate_tty="true")
    assert asked.get_stdout() == "True True\n"


_MASK = "import signal; print(signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, []))"


@pytest.mark.parametrize("is_own", [True, False])
def test_only_commands_of_ours_begin_deaf_to_ctrl_c(
    run: Run, monkeypatch: pytest.MonkeyPatch, is_own: bool
) -> None:
    monkeypatch.setattr(child_process, "is_own_command", lambda _words, _path: is_own)
    one = a.ExecuteProcess(cmd=[sys.executable, "-c", _MASK], output="screen")
    assert any(line.endswith(f"] {is_own}") for line in run(one).lines)
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])


def test_a_shell_takes_the_words_joined(run: Run) -> None:
    process = a.ExecuteProcess(cmd=["echo a &&", "echo b"], shell=True, cached_output=True)
    run(process)
    assert process.get_stdout() == "a\nb\n"


def test_the_prefix_of_the_command_line_goes_before_what_its_filter_names(run: Run) -> None:
    one, two = a.ExecuteProcess(cmd=["true"]), a.ExecuteProcess(cmd=["false"])
    own = a.ExecuteProcess(cmd=["false"], prefix="nice")
    run(one, two, own, **{"launch-prefix": "env -u X", "launch-prefix-filter": "tr"})
    assert one.cmd == ["env", "-u", "X", "true"]
    assert two.cmd == ["false"]
    assert own.cmd == ["nice", "false"]


def test_what_began_before_an_error_ends_with_the_launch(run: Run) -> None:
    """The error stands among entities that one description yields."""

    def fail(_context: Any) -> None:
        raise LookupError("no such package")

    first = a.ExecuteProcess(cmd=["sleep", "60"])
    second = a.ExecuteProcess(cmd=["sleep", "60"])
    ran = run(a.GroupAction([first, second]), a.OpaqueFunction(function=fail))
    assert ran.code == 1 and "no such package" in ran.text
    for process in (first, second):
        assert process.process_details is not None
        assert not psutil.pid_exists(process.process_details["pid"])
        assert process.return_code == -signal.SIGINT


def test_a_process_that_dies_is_told_with_code_and_command(run: Run) -> None:
    process = a.ExecuteProcess(cmd=["sh", "-c", "exit 3"])
    ran = run(process)
    pid = process.process_details["pid"] if process.process_details else 0
    died = f"process has died [pid {pid}, exit code 3, cmd 'sh -c exit 3']."
    assert f"[ERROR] [{process.name}]: {died}" in ran.lines
    assert (ran.code, process.return_code) == (0, 3)


def test_a_process_is_respawned_as_often_as_allowed(run: Run) -> None:
    process = a.ExecuteProcess(
        cmd=["true"], respawn=LaunchConfiguration("again"), respawn_max_retries=2
    )
    ran = run(process, again="true")
    assert ran.text.count("process started with pid") == 3
    once = a.ExecuteProcess(cmd=["true"], respawn=LaunchConfiguration("again"))
    assert run(once, again="false").text.count("process started with pid") == 1


def test_respawn_waits_its_delay_and_ends_with_the_launch(run: Run) -> None:
    slow = a.ExecuteProcess(cmd=["true"], respawn=True, respawn_delay=3600.0)
    with at_most(PATIENCE_S):
        ran = run(slow, a.TimerAction(period=0.3, actions=[a.Shutdown()]))
    assert ran.text.count("process started with pid") == 1


def test_on_exit_ends_the_launch(run: Run) -> None:
    required = a.ExecuteProcess(cmd=["true"], on_exit=a.Shutdown())
    other = a.ExecuteProcess(cmd=["sleep", "60"])
    ran = run(other, required)
    told = f"process[{required.name}] was required: shutting down launched system"
    assert f"[INFO] [launch]: {told}" in ran.lines
    assert other.return_code == -signal.SIGINT


def test_nothing_begins_while_the_launch_ends(run: Run) -> None:
    late = a.ExecuteProcess(cmd=["true"])
    first = a.ExecuteProcess(cmd=["sleep", "60"], on_exit=[late])
    ran = run(first, a.TimerAction(period=0.2, actions=[a.Shutdown()]))
    assert ran.text.count("process started with pid") == 1


def test_what_was_started_last_ends_first(run: Run) -> None:
    first, last = (a.ExecuteProcess(cmd=["sleep", "60"], name=name) for name in ("f", "l"))
    ran = run(first, last, a.TimerAction(period=0.3, actions=[a.Shutdown()]))
    text = "sending signal 'SIGINT' to process[{}]"
    assert 0 < ran.text.index(text.format(last.name)) < ran.text.index(text.format(first.name))


@pytest.mark.parametrize(
    ("ignored", "expected"), [("(2,)", signal.SIGTERM), ("(2, 15)", signal.SIGKILL)]
)
def test_signals_grow_stronger(run: Run, ignored: str, expected: signal.Signals) -> None:
    process = a.ExecuteProcess(
        cmd=[sys.executable, "-c", _STUBBORN.format(signals=ignored)],
        sigterm_timeout="0.1",
        sigkill_timeout=LaunchConfiguration("patience", default=0.1),
    )
    ready = OnProcessIO(target_action=process, on_stdout=lambda _event: a.Shutdown())
    ran = run(a.RegisterEventHandler(ready), process)
    assert process.return_code == -expected
    name = process.name
    text = f"process[{name}] failed to terminate '0.1' seconds after receiving 'SIGINT', "
    assert f"[ERROR] [{name}]: {text}escalating to 'SIGTERM'" in ran.lines
    assert ("escalating to 'SIGKILL'" in ran.text) is (expected is signal.SIGKILL)


def test_a_shutdown_before_the_start_waits_for_it(run: Run) -> None:
    process = a.ExecuteProcess(cmd=["sleep", "60"])
    ran = run(process, a.Shutdown())
    assert process.return_code == -signal.SIGINT
    assert ran.code == 0


def test_an_action_runs_once(run: Run) -> None:
    process = a.ExecuteProcess(cmd=["true"])
    ran = run(process, process)
    assert ran.code == 1
    assert "executed more than once" in ran.text


def test_cached_output_has_to_be_asked_for(run: Run) -> None:
    process = a.ExecuteProcess(cmd=["true"])
    run(process)
    with pytest.raises(RuntimeError, match="cached output must be true to be able to get stderr"):
        process.get_stderr()


def test_signal_events_go_to_the_process_alone(run: Run) -> None:
    code = "trap 'exit 7' USR1; sleep 60 >/dev/null 2>&1 & echo up; wait $!; exit 1"
    process = a.ExecuteProcess(cmd=["sh", "-c", code])
    event = process_events.SignalProcess(
        signal_number=signal.SIGUSR1, process_matcher=process_events.matches_executable("sh")
    )
    ready = OnProcessIO(
        target_action=process, on_stdout=lambda _: a.EmitEvent(event=event), handle_once=True
    )
    run(a.RegisterEventHandler(ready), process)
    assert process.return_code == 7


@pytest.mark.parametrize(
    ("number", "words"),
    [
        (signal.SIGINT, "[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)"),
        (
            signal.SIGTERM,
            "[ERROR] [launch]: user interrupted with ctrl-\\ (SIGTERM), terminating...",
        ),
    ],
)
def test_a_signal_to_the_launcher_ends_everything_in_order(
    run: Run, number: signal.Signals, words: str
) -> None:
    process = a.ExecuteProcess(cmd=["sh", "-c", "echo up; trap '' INT; exec sleep 60"])
    inner = a.ExecuteProcess(cmd=[sys.executable, "-c", _STUBBORN.format(signals="()")])
    ready = OnProcessIO(
        target_action=inner,
        on_stdout=lambda _event: os.kill(os.getpid(), number),
        handle_once=True,
    )
    before = signal.getsignal(number)
    ran = run(a.RegisterEventHandler(ready), process, inner, sigterm_timeout="0.3")
    assert words in ran.lines
    assert inner.return_code not in (None, 0)
    assert (ran.code, signal.getsignal(number)) == (0, before)


def _end_from_thread(service: LaunchService) -> a.OpaqueFunction:
    """End a service from another thread, a moment after it has begun."""
    timer = threading.Timer(_SOON_S, service.shutdown)
    return a.OpaqueFunction(function=lambda _context: timer.start())


def test_a_service_can_be_ended_from_a_thread_and_run_again(run: Run) -> None:
    def end_soon(service: LaunchService) -> None:
        service.include_launch_description(LaunchDescription([_end_from_thread(service)]))

    ran = run(a.ExecuteProcess(cmd=["sleep", "60"]), during=end_soon)
    assert ran.code == 0
    service = LaunchService()
    for word in ("a", "b"):
        service.include_launch_description(LaunchDescription([a.LogInfo(msg=word)]))
        assert service.run() == 0


def test_a_service_may_stay_when_idle(run: Run) -> None:
    service = LaunchService()
    service.include_launch_description(LaunchDescription([_end_from_thread(service)]))
    began = time.monotonic()
    assert service.run(shutdown_when_idle=False) == 0
    assert time.monotonic() - began >= _SOON_S


def test_what_a_process_left_behind_ends_with_the_launch(run: Run, tmp_path: Path) -> None:
    note = tmp_path / "pid"
    run(a.ExecuteProcess(cmd=["sh", "-c", f"trap '' INT TERM; sleep 9999 & echo $! > {note}"]))
    pid = int(note.read_text(encoding="utf-8"))
    # It was killed, and needs a core once more to be gone.
    eventually(lambda: is_gone(pid))


_LAUNCHER = """
from gazelle.launch import watchdog
from gazelle.launch.ros2 import LaunchDescription, LaunchService
from gazelle.launch.ros2.actions import ExecuteProcess
watchdog._PATIENCE_S = 0.2
service = LaunchService()
code = "trap '' INT TERM; sleep 60 & echo pids $$ $!; wait"
service.include_launch_description(LaunchDescription([
    ExecuteProcess(cmd=["sh", "-c", code], output="screen"),
    ExecuteProcess(cmd=[code], shell=True, output="screen"),
]))
service.run()
"""


def test_no_process_survives_a_launcher_that_is_killed() -> None:
    words = [sys.executable, "-u", "-c", _LAUNCHER]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as launcher:
        assert launcher.stdout is not None
        lines = (line for line in launcher.stdout if "] pids " in line)
        pids = [int(word) for _ in range(2) for word in next(lines).split()[-2:]]
        launcher.kill()
        eventually(lambda: all(map(is_gone, pids)))


def test_log_files_are_below_a_folder_of_the_run(run: Run) -> None:
    ran = run(a.LogInfo(msg="a"))
    folder = Path(logging.launch_config.log_dir)
    assert f"[INFO] [launch]: All log files can be found below {folder}" in ran.lines
    assert "[INFO] [launch]: Default logging verbosity is set to INFO" in ran.lines
    assert (folder.parent / "latest").resolve() == folder
    assert folder.name.endswith(f"-{os.getpid()}")
    assert "[INFO] [launch.user]: a" in _log("launch.log")
