"""Running launch tests: the launch in the main thread, its tests beside it and behind it."""

from __future__ import annotations

import inspect
import sys
import threading
import time
import unittest
from collections.abc import Sequence
from typing import Any, TextIO

from gazelle.launch.ros2.actions import IncludeLaunchDescription, RegisterEventHandler
from gazelle.launch.ros2.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart
from gazelle.launch.ros2.launch_description import LaunchDescription
from gazelle.launch.ros2.launch_description_source import LaunchDescriptionSource
from gazelle.launch.ros2.launch_service import LaunchService
from gazelle.launch.ros2.launch_testing.loader import TestRun
from gazelle.launch.ros2.launch_testing.process_handlers import (
    ActiveIoHandler,
    ActiveProcInfoHandler,
)
from gazelle.launch.ros2.launch_testing.test_result import FailResult, SkipResult, TestResult

__all__ = ["LaunchTestRunner", "parse_launch_arguments"]

_MOMENT_S = 1.0


class LaunchTestRunner:
    """Runs launch tests one after another."""

    def __init__(
        self,
        test_runs: Sequence[TestRun],
        launch_file_arguments: Sequence[str] = (),
        debug: bool = False,
    ) -> None:
        self._test_runs = test_runs
        self._launch_file_arguments = launch_file_arguments
        self._debug = debug

    def generate_preamble(self) -> list[Any]:
        """Return what is visited before each description; subclasses add to it."""
        return []

    def run(self) -> dict[TestRun, Any]:
        """Return the result of each run; after a launch that died no other one begins."""
        results: dict[TestRun, Any] = {}
        for run in self._test_runs:
            if len(self._test_runs) > 1:
                _say(f"\nStarting test run {run}")
            worker = _Worker(run, self._launch_file_arguments, debug=self._debug)
            found: Any
            try:
                found = worker.run(self.generate_preamble())
            except unittest.SkipTest as reason:
                _say(f"{run} is skipped: {reason}")
                found = SkipResult(run, str(reason))
            if found is None:
                message = "Launch stopped before the active tests finished."
                results[run] = FailResult(run, message)
                break
            results[run] = found
        return results

    def validate(self) -> None:
        """Check that the functions take what ``parametrize`` gives.

        Raises:
            Exception: an argument is missing or has no value.
        """
        for run in self._test_runs:
            function = inspect.unwrap(run._test_description_function)
            names = [name for name in inspect.signature(function).parameters if name != "ready_fn"]
            for name in run.param_args:
                if name not in names:
                    raise Exception(
                        "Could not find an argument in generate_test_description matching "
                        f"prametrized argument '{name}'"
                    )
            for name in names:
                if name not in run.param_args:
                    raise Exception(
                        f"generate_test_description has unexpected extra argument '{name}'"
                    )


class _Worker:
    """Runs one launch with its tests."""

    def __init__(self, run: TestRun, arguments: Sequence[str], *, debug: bool) -> None:
        self._run = run
        self._arguments = parse_launch_arguments(arguments)
        self._service = LaunchService(debug=debug)
        self._is_ready = threading.Event()
        self._is_tested = threading.Event()
        self._result: TestResult | None = None
        self._progress = _Progress()
        self._info = ActiveProcInfoHandler()
        self._output = ActiveIoHandler()

    def run(self, preamble: list[Any]) -> TestResult | None:
        """Return what the tests came to, None when the launch ended before them."""
        description, known = self._run.normalized_test_description(self._is_ready.set)
        self._bind({**known, **self._run.param_args})
        include = IncludeLaunchDescription(
            LaunchDescriptionSource(description), launch_arguments=self._arguments
        )
        entities = [*preamble, *self._watchers(), include]
        self._service.include_launch_description(LaunchDescription(entities))
        tests = threading.Thread(target=self._test, name="test_runner_thread", daemon=True)
        tests.start()
        keeps_alive = self._run.markers.get("keep_alive", False)
        self._service.run(shutdown_when_idle=not keeps_alive)
        self._let_answered_tests_end(tests)
        result = self._result
        if result is None:
            self._progress.end()
            _say("Processes under test stopped before tests completed")
            self._show_output()
            return None
        result.append(_run_suite(self._run.post_shutdown_tests, self._progress))
        return result

    def _let_answered_tests_end(self, tests: threading.Thread) -> None:
        """The end of the last process may be what they have waited for."""
        if max(self._info.heard_s, self._output.heard_s) > time.monotonic() - _MOMENT_S:
            tests.join(_MOMENT_S)

    def _bind(self, known: dict[str, Any]) -> None:
        both = {"test_args": dict(self._arguments)}
        active = {
            **both,
            "launch_service": self._service,
            "proc_info": self._info,
            "proc_output": self._output,
        }
        over = {
            **both,
            "proc_info": self._info._proc_info_handler,
            "proc_output": self._output._io_handler,
        }
        self._run.bind(self._run.pre_shutdown_tests, active, {**known, **active})
        self._run.bind(self._run.post_shutdown_tests, over, {**known, **over})

    def _watchers(self) -> list[RegisterEventHandler]:
        output, info = self._output, self._info
        handlers = [
            OnProcessStart(on_start=lambda event, _context: info.append(event)),
            OnProcessStart(on_start=lambda event, _context: output.track(event.process_name)),
            OnProcessExit(on_exit=lambda event, _context: info.append(event)),
            OnProcessIO(on_stdout=output.append, on_stderr=output.append),
        ]
        return [RegisterEventHandler(handler) for handler in handlers]

    def _test(self) -> None:
        if not self._is_ready.wait(self._run.timeout):
            _say("Timed out waiting for processes to start up")
            self._service.shutdown()
            return
        try:
            self._result = _run_suite(self._run.pre_shutdown_tests, self._progress)
        finally:
            self._is_tested.set()
            self._service.shutdown()

    def _show_output(self) -> None:
        for event in self._info:
            code = getattr(event, "returncode", 0)
            if code == 0:
                continue
            name = event.process_name
            head = f"##### '{name}' output #####"
            _say(f"Process '{name}' exited with {code}\n{head}")
            for one in self._output[event.action]:
                _say(one.text.decode(errors="replace"))
            _say("#" * len(head))


def parse_launch_arguments(launch_arguments: Sequence[str]) -> list[tuple[str, str]]:
    """Return the pairs of ``name:=value`` words; of several for a name the last one counts.

    Raises:
        RuntimeError: a word is something else.
    """
    found: dict[str, str] = {}
    for word in launch_arguments:
        name, separator, value = word.partition(":=")
        if not separator or not name or not value:
            raise RuntimeError(
                f"malformed launch argument '{word}', expected format '<name>:=<value>'"
            )
        found[name] = value
    return list(found.items())


class _Progress:
    """Where a suite writes how it gets on, until nobody waits for it any more.

    Its thread goes on where the processes under test ended first, and what was its output may be
    closed by then.
    """

    def __init__(self) -> None:
        self._out: TextIO | None = sys.stdout

    def write(self, text: str) -> None:
        if (out := self._out) is not None:
            out.write(text)

    def flush(self) -> None:
        if (out := self._out) is not None:
            out.flush()

    def end(self) -> None:
        self._out = None


def _run_suite(suite: unittest.TestSuite, progress: _Progress) -> TestResult:
    kind: Any = TestResult
    stream: Any = progress
    runner = unittest.TextTestRunner(stream=stream, verbosity=2, resultclass=kind)
    found = runner.run(suite)
    assert isinstance(found, TestResult)
    return found


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
