"""Every action of launch does what it says."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.patience import PATIENCE_S, at_most

from gazelle.launch.ros2 import Action, LaunchContext, LaunchDescription, LaunchDescriptionSource
from gazelle.launch.ros2 import actions as a
from gazelle.launch.ros2.conditions import IfCondition, UnlessCondition
from gazelle.launch.ros2.descriptions import Executable
from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.event_handler import EventHandler
from gazelle.launch.ros2.event_handlers import OnExecutionComplete, OnShutdown
from gazelle.launch.ros2.substitutions import EnvironmentVariable, LaunchConfiguration

Run = Callable[..., Any]
_ROWS: dict[str, Callable[[Run], None]] = {}


def _row(test: Callable[[Run], None]) -> Callable[[Run], None]:
    _ROWS[test.__name__] = test
    return test


@pytest.mark.parametrize("name", a.__all__)
def test_action(name: str, run: Run) -> None:
    _ROWS[name](run)


def _say(name: str) -> a.LogInfo:
    return a.LogInfo(msg=[name, " is ", LaunchConfiguration(name, default="unset")])


def _environment(name: str) -> a.LogInfo:
    return a.LogInfo(msg=[name, " is ", EnvironmentVariable(name, default_value="unset")])


def _said(ran: Any) -> list[str]:
    head = "[INFO] [launch.user]: "
    return [line.removeprefix(head) for line in ran.lines if line.startswith(head)]


class _Bell(Event):
    name = "bell"


def _on_bell(*entities: Action) -> EventHandler:
    return EventHandler(matcher=lambda event: isinstance(event, _Bell), entities=entities)


@_row
def DeclareLaunchArgument(run: Run) -> None:
    declared = a.DeclareLaunchArgument("speed", default_value="slow", choices=["slow", "fast"])
    assert declared.description == "One of: ['slow', 'fast']"
    assert _said(run(declared, _say("speed"))) == ["speed is slow"]
    again = a.DeclareLaunchArgument("speed", default_value="slow")
    assert _said(run(again, _say("speed"), speed="fast")) == ["speed is fast"]


@_row
def SetLaunchConfiguration(run: Run) -> None:
    assert _said(run(a.SetLaunchConfiguration("x", "1"), _say("x"))) == ["x is 1"]


@_row
def UnsetLaunchConfiguration(run: Run) -> None:
    ran = run(a.UnsetLaunchConfiguration("x"), a.UnsetLaunchConfiguration("y"), _say("x"), x="1")
    assert _said(ran) == ["x is unset"]


@_row
def PushLaunchConfigurations(run: Run) -> None:
    push, pop = a.PushLaunchConfigurations(), a.PopLaunchConfigurations()
    ran = run(push, a.SetLaunchConfiguration("x", "2"), _say("x"), pop, _say("x"), x="1")
    assert _said(ran) == ["x is 2", "x is 1"]


@_row
def PopLaunchConfigurations(run: Run) -> None:
    ran = run(a.PopLaunchConfigurations())
    assert ran.code == 1
    assert "launch_configurations stack unexpectedly empty" in ran.text


@_row
def ResetLaunchConfigurations(run: Run) -> None:
    kept = {"y": [LaunchConfiguration("x"), "!"]}
    ran = run(a.ResetLaunchConfigurations(kept), _say("x"), _say("y"), x="1")
    assert _said(ran) == ["x is unset", "y is 1!"]


@_row
def SetEnvironmentVariable(run: Run) -> None:
    ran = run(a.SetEnvironmentVariable("GZ_X", "1"), _environment("GZ_X"))
    assert _said(ran) == ["GZ_X is 1"]
    assert os.environ["GZ_X"] == "1"


@_row
def UnsetEnvironmentVariable(run: Run) -> None:
    os.environ["GZ_X"] = "1"
    ran = run(a.UnsetEnvironmentVariable("GZ_X"), _environment("GZ_X"))
    assert _said(ran) == ["GZ_X is unset"]


@_row
def AppendEnvironmentVariable(run: Run) -> None:
    ran = run(
        a.AppendEnvironmentVariable("GZ_X", "b"),
        a.AppendEnvironmentVariable("GZ_X", "c"),
        a.AppendEnvironmentVariable("GZ_X", "a", prepend=True, separator="|"),
        _environment("GZ_X"),
    )
    assert _said(ran) == ["GZ_X is a|b:c"]


@_row
def PushEnvironment(run: Run) -> None:
    setting = a.SetEnvironmentVariable("GZ_X", "1")
    ran = run(
        a.PushEnvironment(), setting, _environment("GZ_X"), a.PopEnvironment(), _environment("GZ_X")
    )
    assert _said(ran) == ["GZ_X is 1", "GZ_X is unset"]


@_row
def PopEnvironment(run: Run) -> None:
    ran = run(a.PopEnvironment())
    assert ran.code == 1
    assert "environment stack unexpectedly empty" in ran.text


@_row
def ResetEnvironment(run: Run) -> None:
    os.environ["GZ_OLD"] = "1"
    ran = run(
        a.SetEnvironmentVariable("GZ_NEW", "1"),
        a.UnsetEnvironmentVariable("GZ_OLD"),
        a.ResetEnvironment(),
        _environment("GZ_NEW"),
        _environment("GZ_OLD"),
    )
    assert _said(ran) == ["GZ_NEW is unset", "GZ_OLD is 1"]


@_row
def ForEach(run: Run) -> None:
    each = a.ForEach("{n: a};{n: b}", function=lambda n: [a.LogInfo(msg=f"robot {n}")])
    assert _said(run(each)) == ["robot a", "robot b"]


@_row
def ForLoop(run: Run) -> None:
    loop = a.ForLoop(LaunchConfiguration("x"), function=lambda i: [a.LogInfo(msg=f"round {i}")])
    assert _said(run(loop, x="2")) == ["round 0", "round 1"]


@_row
def Log(run: Run) -> None:
    ran = run(a.Log(msg="careful", level=LaunchConfiguration("x")), x="WARNING")
    assert "[WARNING] [launch.user]: careful" in ran.lines


@_row
def LogDebug(run: Run) -> None:
    assert "quiet" not in run(a.LogDebug(msg="quiet")).text


@_row
def LogWarning(run: Run) -> None:
    assert "[WARNING] [launch.user]: careful" in run(a.LogWarning(msg="careful")).lines


@_row
def LogError(run: Run) -> None:
    ran = run(a.LogError(msg="broken"))
    assert "[ERROR] [launch.user]: broken" in ran.lines and ran.code == 0


@_row
def LogInfo(run: Run) -> None:
    ran = run(a.LogInfo(msg=["a ", LaunchConfiguration("x")]), x="word")
    assert "[INFO] [launch.user]: a word" in ran.lines


@_row
def EmitEvent(run: Run) -> None:
    ran = run(a.RegisterEventHandler(_on_bell(a.LogInfo(msg="ding"))), a.EmitEvent(event=_Bell()))
    assert _said(ran) == ["ding"]
    with pytest.raises(RuntimeError, match=r"EmitEvent\(\) expected an event instance, got 'bell'"):
        a.EmitEvent(event="bell")  # type: ignore[arg-type]


@_row
def RegisterEventHandler(run: Run) -> None:
    once = EventHandler(
        matcher=lambda event: isinstance(event, _Bell),
        entities=a.LogInfo(msg="once"),
        handle_once=True,
    )
    always = a.RegisterEventHandler(_on_bell(a.LogInfo(msg="always")))
    bells = [a.EmitEvent(event=_Bell()), a.EmitEvent(event=_Bell())]
    ran = run(always, a.RegisterEventHandler(once), *bells)
    # What is registered later is asked first.
    assert _said(ran) == ["once", "always", "always"]


@_row
def UnregisterEventHandler(run: Run) -> None:
    handler = _on_bell(a.LogInfo(msg="ding"))
    ran = run(
        a.RegisterEventHandler(handler),
        a.UnregisterEventHandler(handler),
        a.EmitEvent(event=_Bell()),
    )
    assert (ran.code, _said(ran)) == (0, [])
    assert run(a.UnregisterEventHandler(handler)).code == 1


@_row
def Shutdown(run: Run) -> None:
    reasons = []
    told = OnShutdown(on_shutdown=lambda event, _context: reasons.append(event.reason))
    with at_most(PATIENCE_S):
        ran = run(
            a.RegisterEventHandler(told),
            a.ExecuteProcess(cmd=["sleep", "3600"]),
            a.TimerAction(period=3600.0, actions=[]),
            a.Shutdown(reason="enough"),
        )
    assert ran.code == 0
    assert reasons == ["enough"]


@_row
def OpaqueFunction(run: Run) -> None:
    def function(context: LaunchContext, word: str, *, times: int) -> list[Action]:
        return [a.LogInfo(msg=word + context.launch_configurations["x"])] * times

    ran = run(a.OpaqueFunction(function=function, args=["x="], kwargs={"times": 2}), x="1")
    assert _said(ran) == ["x=1", "x=1"]
    with pytest.raises(TypeError, match="OpaqueFunction expected a callable for 'function'"):
        a.OpaqueFunction(function=3)


@_row
def OpaqueCoroutine(run: Run) -> None:
    seen = []

    async def coroutine(context: LaunchContext, word: str) -> None:
        seen.append((context.launch_configurations["x"], word))

    async def alone(word: str) -> None:
        seen.append(("", word))

    run(
        a.OpaqueCoroutine(coroutine=coroutine, args=["a"]),
        a.OpaqueCoroutine(coroutine=alone, kwargs={"word": "b"}, ignore_context=True),
        x="1",
    )
    assert seen == [("1", "a"), ("", "b")]

    async def wrong() -> None:
        raise ValueError("of the coroutine")

    busy = a.TimerAction(period=0.2, actions=[a.LogInfo(msg="never")])
    ran = run(a.OpaqueCoroutine(coroutine=wrong, ignore_context=True), busy, a.LogInfo(msg="a"))
    assert (ran.code, _said(ran)) == (1, ["a"])
    assert "Caught exception in launch (see debug for traceback): of the coroutine" in ran.text
    with pytest.raises(TypeError, match="OpaqueCoroutine expected a coroutine function"):
        a.OpaqueCoroutine(coroutine=print)  # type: ignore[arg-type]


@_row
def GroupAction(run: Run) -> None:
    inner = [
        a.SetLaunchConfiguration("x", "2"),
        a.SetEnvironmentVariable("GZ_X", "2"),
        _say("x"),
        _say("y"),
        _say("z"),
    ]
    outside = [_say("x"), _environment("GZ_X")]
    scoped = a.GroupAction(inner, launch_configurations={"z": "3"})
    assert _said(run(scoped, *outside, x="1", y="1")) == [
        *["x is 2", "y is 1", "z is 3"],
        *["x is 1", "GZ_X is unset"],
    ]
    open_group = a.GroupAction(inner, scoped=False)
    assert _said(run(open_group, *outside))[-2:] == ["x is 2", "GZ_X is 2"]
    closed = a.GroupAction(inner, forwarding=False, launch_configurations={"z": "3"})
    assert _said(run(closed, x="1", y="1")) == ["x is 2", "y is unset", "z is 3"]


@_row
def IncludeLaunchDescription(run: Run) -> None:
    description = LaunchDescription([a.DeclareLaunchArgument("x"), _say("x")])
    source = LaunchDescriptionSource(description)
    include = a.IncludeLaunchDescription(source, launch_arguments=[("x", LaunchConfiguration("y"))])
    assert _said(run(include, _say("x"), y="1")) == ["x is 1", "x is 1"]


@_row
def TimerAction(run: Run) -> None:
    began = time.monotonic()
    late = a.TimerAction(period=0.2, actions=[a.LogInfo(msg="late")])
    ran = run(late, a.TimerAction(period=0.1, actions=[a.LogInfo(msg="early")]))
    assert _said(ran) == ["early", "late"]
    assert time.monotonic() - began >= 0.2
    cancelled = a.TimerAction(period=60.0, actions=[a.LogInfo(msg="never")])
    cancel = a.OpaqueFunction(function=lambda _context: cancelled.cancel())
    assert _said(run(cancelled, cancel)) == []
    with pytest.raises(TypeError, match=r"'TimerAction' expected 'period' to be .* write 8\.0"):
        a.TimerAction(period=8, actions=[])
    with pytest.raises(TypeError, match="'TimerAction' expected 'actions' to be one of"):
        a.TimerAction(period=8.0, actions=None)  # type: ignore[arg-type]


@_row
def ExecuteLocal(run: Run) -> None:
    what = Executable(
        cmd=["env"],
        name="me",
        env={"A": "1"},
        additional_env={"B": LaunchConfiguration("x")},
        arguments=["-u", "C"],
    )
    process = a.ExecuteLocal(process_description=what, cached_output=True)
    run(process, x="2")
    name = what.final_name
    assert name is not None
    assert name.startswith("me-")
    assert what.final_cmd == ["env", "-u", "C"]
    assert set(process.get_stdout().splitlines()) >= {"A=1", "B=2"}
    assert process.get_stderr() == ""
    assert process.return_code == 0


@_row
def ExecuteProcess(run: Run) -> None:
    folder = str(Path(__file__).parent)
    process = a.ExecuteProcess(
        cmd=["pwd"], prefix="nice -n 1", cwd=folder, output="screen", log_cmd=True
    )
    ran = run(process)
    name = process.name
    pid = process.process_details["pid"] if process.process_details else 0
    assert process.cmd == ["nice", "-n", "1", "pwd"]
    custom = f"process details: cmd='nice -n 1 pwd', cwd='{folder}', custom_env?=True"
    assert ran.lines[2:] == [
        f"[INFO] [{name}]: {custom}",
        f"[INFO] [{name}]: process started with pid [{pid}]",
        f"[{name}] {folder}",
        f"[INFO] [{name}]: process has finished cleanly [pid {pid}]",
    ]


def test_an_action_runs_only_if_its_condition_holds(run: Run) -> None:
    ran = run(
        a.LogInfo(msg="if", condition=IfCondition(LaunchConfiguration("x"))),
        a.LogInfo(msg="unless", condition=UnlessCondition(LaunchConfiguration("x"))),
        x="True",
    )
    assert _said(ran) == ["if"]


def test_the_completion_of_an_action_is_told(run: Run) -> None:
    first = a.LogInfo(msg="first")
    process = a.ExecuteProcess(cmd=["true"])
    told = [
        a.RegisterEventHandler(
            OnExecutionComplete(target_action=action, on_completion=[a.LogInfo(msg=word)])
        )
        for action, word in ((first, "first is done"), (process, "process is done"))
    ]
    assert _said(run(*told, first, process)) == ["first", "first is done", "process is done"]


def test_arguments_have_descriptions_and_choices() -> None:
    plain = a.DeclareLaunchArgument("x")
    assert (plain.description, plain.default_value) == ("no description given", None)
    one = a.DeclareLaunchArgument("x", description="speed", choices=["a", "b"])
    assert one.description == "speed. Valid choices are: ['a', 'b']"
    with pytest.raises(RuntimeError, match="Provided choices arg is empty"):
        a.DeclareLaunchArgument("x", choices=[])
    with pytest.raises(RuntimeError, match='default_value "c" is not in provided choices'):
        a.DeclareLaunchArgument("x", default_value="c", choices=["a", "b"])


def test_arguments_behind_conditions_are_not_asked_for_before() -> None:
    include = a.IncludeLaunchDescription(
        LaunchDescriptionSource(LaunchDescription([a.DeclareLaunchArgument("inner")]))
    )
    group = a.GroupAction([a.DeclareLaunchArgument("grouped")], condition=IfCondition("true"))
    description = LaunchDescription([a.DeclareLaunchArgument("own"), include, group])
    found = description.get_launch_arguments()
    assert [one.name for one in found] == ["own", "inner", "grouped"]
    assert [one._conditionally_included for one in found] == [False, False, True]
    reset = LaunchDescription([a.ResetLaunchConfigurations(), a.DeclareLaunchArgument("hidden")])
    assert reset.get_launch_arguments() == []


def test_a_deprecated_description_says_so(run: Run) -> None:
    ran = run(LaunchDescription(deprecated_reason="use the other"))
    assert "[WARNING] [launch]: deprecated launch description: use the other" in ran.lines
