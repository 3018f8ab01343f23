"""Every condition, event, handler and source of launch does what it says."""

from __future__ import annotations

import signal
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.launch.ros2 import (
    LaunchContext,
    LaunchDescription,
    conditions,
    event_handlers,
    events,
    launch_description_sources,
)
from gazelle.launch.ros2 import actions as a
from gazelle.launch.ros2.events import process
from gazelle.launch.ros2.substitutions import LaunchConfiguration, TextSubstitution

Run = Callable[..., Any]
_ROWS: dict[str, Callable[..., None]] = {}
_NAMES = [
    *conditions.__all__,
    *event_handlers.__all__,
    *(name for name in events.__all__ if name != "process"),
    *process.__all__,
    *launch_description_sources.__all__,
]


def _row(test: Callable[..., None]) -> Callable[..., None]:
    _ROWS[test.__name__] = test
    return test


@pytest.mark.parametrize("name", dict.fromkeys(_NAMES))
def test_name(name: str, run: Run, context: LaunchContext, tmp_path: Path) -> None:
    have = {"run": run, "context": context, "tmp_path": tmp_path}
    test = _ROWS[name]
    test(**{key: have[key] for key in test.__annotations__ if key in have})


def _handled(ran: Any) -> list[str]:
    head = "[INFO] [launch.user]: "
    return [line.removeprefix(head) for line in ran.lines if line.startswith(head)]


def _told(event: type, function: Callable[[Any], Any]) -> a.RegisterEventHandler:
    """Call a function with every event of a class."""
    from gazelle.launch.ros2 import EventHandler

    call = a.OpaqueFunction(function=lambda context: function(context.locals.event))
    return a.RegisterEventHandler(
        EventHandler(matcher=lambda one: isinstance(one, event), entities=call)
    )


@_row
def VALID_TRUE_EXPRESSIONS(run: Run) -> None:
    for text in conditions.VALID_TRUE_EXPRESSIONS:
        assert _handled(
            run(a.LogInfo(msg="on", condition=conditions.IfCondition(text.upper())))
        ) == ["on"]


@_row
def VALID_FALSE_EXPRESSIONS(run: Run) -> None:
    for text in conditions.VALID_FALSE_EXPRESSIONS:
        assert not _handled(
            run(a.LogInfo(msg="on", condition=conditions.IfCondition(text.upper())))
        )


@_row
def IfCondition(context: LaunchContext) -> None:
    context.launch_configurations["x"] = " TRUE "
    assert conditions.IfCondition(LaunchConfiguration("x")).evaluate(context)
    assert not conditions.IfCondition("0").evaluate(context)


@_row
def UnlessCondition(context: LaunchContext) -> None:
    assert conditions.UnlessCondition(["fal", "se"]).evaluate(context)
    assert not conditions.UnlessCondition("1").evaluate(context)


@_row
def InvalidConditionExpressionError(context: LaunchContext) -> None:
    message = r"expected one of \[true, 1, false, 0\] but got 'yes', expanded from ''Yes''"
    with pytest.raises(conditions.InvalidConditionExpressionError, match=message):
        conditions.IfCondition("Yes").evaluate(context)


@_row
def LaunchConfigurationEquals(context: LaunchContext) -> None:
    with pytest.warns(UserWarning, match="deprecated"):
        equals = conditions.LaunchConfigurationEquals("x", "1")
        unset = conditions.LaunchConfigurationEquals("x", None)
    assert (equals.evaluate(context), unset.evaluate(context)) == (False, True)
    context.launch_configurations["x"] = "1"
    assert (equals.evaluate(context), unset.evaluate(context)) == (True, False)


@_row
def LaunchConfigurationNotEquals(context: LaunchContext) -> None:
    with pytest.warns(UserWarning, match="deprecated"):
        differs = conditions.LaunchConfigurationNotEquals("x", "1")
        is_set = conditions.LaunchConfigurationNotEquals("x", None)
    assert (differs.evaluate(context), is_set.evaluate(context)) == (True, False)
    context.launch_configurations["x"] = "1"
    assert (differs.evaluate(context), is_set.evaluate(context)) == (False, True)


def test_a_deprecated_condition_is_told_once_however_often_it_stands() -> None:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        for name in "abc":
            conditions.LaunchConfigurationEquals(name, "1")
    (one,) = told
    assert "'LaunchConfigurationEquals' condition is deprecated" in str(one.message)
    assert one.filename == __file__


@_row
def evaluate_condition_expression(context: LaunchContext) -> None:
    expression = [TextSubstitution(text="1")]
    assert conditions.evaluate_condition_expression(context, expression)


@_row
def event_named(context: LaunchContext) -> None:
    matcher = event_handlers.event_named("launch.events.Shutdown")
    assert matcher(events.Shutdown())
    assert not matcher(events.TimerEvent(timer_action=None))


@_row
def OnActionEventBase() -> None:
    given: dict[str, Any] = {"on_event": [], "target_action_cls": a.LogInfo}
    with pytest.raises(TypeError, match="must be a subclass of 'Event'"):
        no_event: Any = str
        event_handlers.OnActionEventBase(action_matcher=None, target_event_cls=no_event, **given)
    with pytest.raises(TypeError, match="action_matcher must be an 'LogInfo' instance or a call"):
        event_handlers.OnActionEventBase(
            action_matcher=3, target_event_cls=events.Shutdown, **given
        )


@_row
def OnExecutionComplete(run: Run) -> None:
    log = a.LogInfo(msg="now")
    handler = event_handlers.OnExecutionComplete(
        target_action=log, on_completion=[a.LogInfo(msg="complete")]
    )
    assert _handled(run(a.RegisterEventHandler(handler), log)) == ["now", "complete"]


@_row
def OnIncludeLaunchDescription(run: Run) -> None:
    inner = LaunchDescription([a.LogInfo(msg="inner")])
    ran = run(a.EmitEvent(event=events.IncludeLaunchDescription(inner)))
    assert _handled(ran) == ["inner"]


@_row
def OnProcessStart(run: Run) -> None:
    wanted, other = a.ExecuteProcess(cmd=["true"]), a.ExecuteProcess(cmd=["true"])
    pids = []
    handler = event_handlers.OnProcessStart(
        target_action=wanted, on_start=lambda event, _context: pids.append(event.pid)
    )
    run(a.RegisterEventHandler(handler), wanted, other)
    assert wanted.process_details is not None
    assert pids == [wanted.process_details["pid"]]


@_row
def OnProcessExit(run: Run) -> None:
    process = a.ExecuteProcess(cmd=["sh", "-c", "exit 3"])
    exits = event_handlers.OnProcessExit(
        target_action=process,
        on_exit=lambda event, _context: [a.LogInfo(msg=f"code {event.returncode}")],
    )
    by_function = event_handlers.OnProcessExit(
        target_action=lambda action: action is process, on_exit=a.LogInfo(msg="picked")
    )
    ran = run(a.RegisterEventHandler(exits), a.RegisterEventHandler(by_function), process)
    assert sorted(_handled(ran)) == ["code 3", "picked"]


@_row
def OnProcessIO(run: Run) -> None:
    process = a.ExecuteProcess(cmd=["sh", "-c", "echo out; echo err >&2"])
    handler = event_handlers.OnProcessIO(
        target_action=process,
        on_stdout=lambda event: a.LogInfo(msg=event.text.decode().strip()),
        on_stderr=lambda event: a.LogInfo(msg=event.text.decode().strip()),
    )
    ran = run(a.RegisterEventHandler(handler), process)
    assert sorted(_handled(ran)) == ["err", "out"]


@_row
def OnShutdown(run: Run) -> None:
    handlers = [
        event_handlers.OnShutdown(on_shutdown=[a.LogInfo(msg="list")]),
        event_handlers.OnShutdown(on_shutdown=lambda *_: [a.LogInfo(msg="function")]),
    ]
    ran = run(*(a.RegisterEventHandler(one) for one in handlers), a.Shutdown())
    assert _handled(ran) == ["function", "list"]


@_row
def ExecutionComplete() -> None:
    log = a.LogInfo(msg="")
    event = events.ExecutionComplete(action=log)
    assert (event.action, event.name) == (log, "launch.events.ExecutionComplete")


@_row
def IncludeLaunchDescription() -> None:
    description = LaunchDescription()
    assert events.IncludeLaunchDescription(description).launch_description is description


@_row
def Shutdown(run: Run) -> None:
    reasons = []
    run(_told(events.Shutdown, lambda event: reasons.append((event.reason, event.due_to_sigint))))
    assert reasons == [("idle", False)]


@_row
def TimerEvent(run: Run) -> None:
    timers = []
    timer = a.TimerAction(period=0.0, actions=[])
    run(_told(events.TimerEvent, lambda event: timers.append(event.timer_action)), timer)
    assert timers == [timer]


@_row
def matches_action() -> None:
    log = a.LogInfo(msg="")
    assert events.matches_action(log)(log)
    assert not events.matches_action(log)(a.LogInfo(msg=""))


def _events_of(run: Run, kind: type, command: str) -> list[Any]:
    seen: list[Any] = []
    run(_told(kind, seen.append), a.ExecuteProcess(cmd=["sh", "-c", command], name="sh"))
    return seen


@_row
def RunningProcessEvent(run: Run) -> None:
    started, ended = _events_of(run, process.RunningProcessEvent, "true")
    assert (started.cmd, started.cwd) == (["sh", "-c", "true"], None)
    assert started.process_name.startswith("sh-")
    assert (started.pid, started.action) == (ended.pid, ended.execute_process_action)
    assert "PATH" in started.env


@_row
def ProcessStarted(run: Run) -> None:
    (event,) = _events_of(run, process.ProcessStarted, "true")
    assert event.pid > 0


@_row
def ProcessExited(run: Run) -> None:
    (event,) = _events_of(run, process.ProcessExited, "kill -9 $$")
    assert event.returncode == -9


@_row
def ProcessIO(run: Run) -> None:
    (event,) = _events_of(run, process.ProcessIO, "echo a")
    assert (event.text, event.from_stdout, event.from_stderr) == (b"a\n", True, False)


@_row
def ProcessStdout(run: Run) -> None:
    (event,) = _events_of(run, process.ProcessStdout, "echo a; echo b >&2")
    assert (event.text, event.fd) == (b"a\n", 1)


@_row
def ProcessStderr(run: Run) -> None:
    (event,) = _events_of(run, process.ProcessStderr, "echo a; echo b >&2")
    assert (event.text, event.fd) == (b"b\n", 2)


@_row
def ProcessStdin(run: Run) -> None:
    reader = a.ExecuteProcess(cmd=["head", "-n", "1"], cached_output=True)

    def report(event: Any, _context: LaunchContext) -> list[Any]:
        details = {**reader.process_details} if reader.process_details else {}
        return [a.EmitEvent(event=process.ProcessStdin(text=b"hello\n", **details))]

    on_start = event_handlers.OnProcessStart(target_action=reader, on_start=report)
    run(a.RegisterEventHandler(on_start), reader)
    assert reader.get_stdout() == "hello\n"


@_row
def ProcessTargetedEvent() -> None:
    matcher = process.matches_pid(1)
    assert process.ProcessTargetedEvent(process_matcher=matcher).process_matcher is matcher


def _when_started(target: a.ExecuteProcess, event: Any) -> a.RegisterEventHandler:
    handler = event_handlers.OnProcessStart(
        target_action=target, on_start=[a.EmitEvent(event=event)]
    )
    return a.RegisterEventHandler(handler)


@_row
def ShutdownProcess(run: Run) -> None:
    victim, other = a.ExecuteProcess(cmd=["sleep", "60"]), a.ExecuteProcess(cmd=["sleep", "0.1"])
    event = process.ShutdownProcess(process_matcher=events.matches_action(victim))
    ran = run(_when_started(victim, event), victim, other)
    assert (victim.return_code, other.return_code) == (-signal.SIGINT, 0)
    assert f"sending signal 'SIGINT' to process[{victim.name}]" in ran.text


@_row
def SignalProcess(run: Run) -> None:
    victim = a.ExecuteProcess(cmd=["sleep", "60"])
    event = process.SignalProcess(
        signal_number=signal.SIGUSR1, process_matcher=process.matches_executable("sleep")
    )
    ran = run(_when_started(victim, event), victim)
    assert victim.return_code == -signal.SIGUSR1
    assert f"sending signal 'SIGUSR1' to process[{victim.name}]" in ran.text
    assert process.SignalProcess(signal_number="SIGKILL", process_matcher=bool).signal == "SIGKILL"
    with pytest.raises(TypeError, match="expected 'signal_number' to be one of"):
        process.SignalProcess(signal_number=9, process_matcher=bool)  # type: ignore[arg-type]


def _finished(run: Run) -> a.ExecuteProcess:
    done = a.ExecuteProcess(cmd=["/bin/true"])
    run(done)
    return done


@_row
def matches_pid(run: Run) -> None:
    done = _finished(run)
    assert done.process_details is not None
    assert process.matches_pid(done.process_details["pid"])(done)
    assert not process.matches_pid(0)(done)


@_row
def matches_name(run: Run) -> None:
    done = _finished(run)
    assert process.matches_name(done.name)(done)
    assert not process.matches_name("true")(a.ExecuteProcess(cmd=["true"]))


@_row
def matches_executable(run: Run) -> None:
    done = _finished(run)
    assert process.matches_executable("true")(done)
    assert not process.matches_executable("false")(done)


_PYTHON = """
from launch import LaunchDescription
from launch.actions import LogInfo
def generate_launch_description():
    return LaunchDescription([LogInfo(msg="from python")])
"""
_XML = '<launch><log message="from xml"/></launch>'
_YAML = "launch:\n- log:\n    message: from yaml\n"


def _includes(run: Run, path: Path, text: str, kind: Any) -> list[str]:
    path.write_text(text, encoding="utf-8")
    source = kind([str(path.parent), "/", path.name])
    return _handled(run(a.IncludeLaunchDescription(source)))


@_row
def PythonLaunchDescriptionSource(run: Run, tmp_path: Path) -> None:
    kind = launch_description_sources.PythonLaunchDescriptionSource
    assert _includes(run, tmp_path / "a.launch.py", _PYTHON, kind) == ["from python"]


@_row
def XMLLaunchDescriptionSource(run: Run, tmp_path: Path) -> None:
    kind = launch_description_sources.XMLLaunchDescriptionSource
    assert _includes(run, tmp_path / "a.launch.xml", _XML, kind) == ["from xml"]


@_row
def YAMLLaunchDescriptionSource(run: Run, tmp_path: Path) -> None:
    kind = launch_description_sources.YAMLLaunchDescriptionSource
    assert _includes(run, tmp_path / "a.launch.yaml", _YAML, kind) == ["from yaml"]


@_row
def FrontendLaunchDescriptionSource(run: Run, tmp_path: Path) -> None:
    kind = launch_description_sources.FrontendLaunchDescriptionSource
    assert _includes(run, tmp_path / "a.launch", _XML, kind) == ["from xml"]
    assert _includes(run, tmp_path / "b.launch", _YAML, kind) == ["from yaml"]


@_row
def AnyLaunchDescriptionSource(run: Run, tmp_path: Path) -> None:
    kind = launch_description_sources.AnyLaunchDescriptionSource
    texts = {"a.launch.py": _PYTHON, "a.launch.xml": _XML, "a.yaml": _YAML, "a.txt": _PYTHON}
    found = [_includes(run, tmp_path / name, text, kind)[0] for name, text in texts.items()]
    assert found == ["from python", "from xml", "from yaml", "from python"]


@_row
def get_launch_description_from_any_launch_file(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.xml"
    path.write_text(_XML, encoding="utf-8")
    read = launch_description_sources.get_launch_description_from_any_launch_file
    assert len(read(str(path)).entities) == 1


@_row
def get_launch_description_from_frontend_launch_file(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.yaml"
    path.write_text(_YAML, encoding="utf-8")
    read = launch_description_sources.get_launch_description_from_frontend_launch_file
    assert len(read(str(path)).entities) == 1


@_row
def get_launch_description_from_python_launch_file(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.py"
    path.write_text(_PYTHON, encoding="utf-8")
    read = launch_description_sources.get_launch_description_from_python_launch_file
    assert len(read(str(path)).entities) == 1
    assert [one.name for one in tmp_path.iterdir() if one.is_dir()] == []


@_row
def load_python_launch_file_as_module(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.py"
    path.write_text("WORD = __file__", encoding="utf-8")
    load = launch_description_sources.load_python_launch_file_as_module
    assert str(path) == load(str(path)).WORD


@_row
def InvalidPythonLaunchFileError(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.py"
    path.write_text("def generate_launch_descripton(): pass", encoding="utf-8")
    read = launch_description_sources.get_launch_description_from_python_launch_file
    kind = launch_description_sources.InvalidPythonLaunchFileError
    with pytest.raises(kind, match=r"required function 'generate_launch_description\(\)'; did you"):
        read(str(path))
    path.write_text("def generate_launch_description(): pass", encoding="utf-8")
    with pytest.raises(kind, match=r"returned a NoneType.*is a return missing"):
        read(str(path))


@_row
def InvalidFrontendLaunchFileError(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.xml"
    path.write_text("<launch>", encoding="utf-8")
    read = launch_description_sources.get_launch_description_from_frontend_launch_file
    kind = launch_description_sources.InvalidFrontendLaunchFileError
    with pytest.raises(kind, match=r"Caught exception when trying to load file of format \[xml\]"):
        read(str(path))


@_row
def InvalidLaunchFileError(tmp_path: Path) -> None:
    path = tmp_path / "launch"
    path.write_text("neither", encoding="utf-8")
    read = launch_description_sources.get_launch_description_from_any_launch_file
    kind = launch_description_sources.InvalidLaunchFileError
    with pytest.raises(kind, match="may have a syntax error, or its format is unknown"):
        read(str(path))
