"""launch_testing: tests beside a launch and behind it, from the command line and in pytest."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.patience import stretched

from gazelle.launch.environment import drop_in_folder
from gazelle.launch.ros2.launch_ros.launch_graph import drop_graph
from gazelle.launch.ros2.launch_testing.launch_test import main
from gazelle.workspace.ament_index import known_workspace

Finished = subprocess.CompletedProcess[str]
_ECHO = """
import sys, threading
try:
    print("warn", file=sys.stderr, flush=True)
    print("start " + sys.argv[1], flush=True)
    threading.Event().wait()
except KeyboardInterrupt:
    print("end " + sys.argv[1], flush=True)
"""
_HEAD = f"""
import sys, unittest
import launch, launch_testing, launch_testing.actions, launch_testing.asserts
import launch_testing.markers, launch_testing.tools, launch_testing.util, pytest
from launch.actions import *
from launch.substitutions import LaunchConfiguration
from launch_testing.actions import ReadyToTest

def echo(word):
    return ExecuteProcess(cmd=[sys.executable, "-c", {_ECHO!r}, word], cached_output=True)
"""
_TWO_RUNS = """
@pytest.mark.launch_test
@launch_testing.parametrize("word", ["one", "two"])
def generate_test_description(word):
    process = echo(word)
    return launch.LaunchDescription([process, ReadyToTest()]), {"process": process}

class Beside(unittest.TestCase):
    def test_output(self, proc_output, process, word):
        proc_output.assertWaitFor(
            "start " + word, process=process, timeout=PATIENCE_S, stream="stdout"
        )
        proc_output.assertWaitFor("warn", process=process, timeout=PATIENCE_S)
    def test_start(self, proc_info, process):
        proc_info.assertWaitForStartup("python", cmd_args=process.cmd[-1], timeout=PATIENCE_S)
        assert len(proc_info.process_names()) == 1
    def test_starting_another(self, launch_service, proc_info, proc_output):
        with launch_testing.tools.launch_process(
            launch_service, echo("more"), proc_info, proc_output
        ) as proxy:
            assert proxy.wait_for_output(lambda text: "start more" in text, timeout=PATIENCE_S)
            assert proxy.running and not proxy.terminated
        assert proxy.wait_for_shutdown(timeout=PATIENCE_S)
        assert proxy.exit_code == 0
        assert "end more" in proxy.stdout and "warn" in proxy.stderr

@launch_testing.post_shutdown_test()
class Behind(unittest.TestCase):
    def test_exit(self, proc_info, process):
        launch_testing.asserts.assertExitCodes(proc_info)
        assert proc_info[process].returncode == 0
    def test_order(self, proc_output, process, word):
        with launch_testing.asserts.assertSequentialStdout(proc_output, process) as checker:
            checker.assertInStdout("start " + word)
            checker.assertInStdout("end " + word)
    def test_not_there(self, proc_output, process):
        with self.assertRaisesRegex(AssertionError, "Did not find 'nope' in output for any"):
            launch_testing.asserts.assertInStdout(proc_output, "nope", process)
"""


def _head() -> str:
    return f"{_HEAD}\nPATIENCE_S = {stretched()}\n"


_PLUGINS = ("-p", "no:cacheprovider")
_PYTEST = ("-m", "pytest", "-q", *_PLUGINS, "check.py")


@pytest.fixture
def launch_test(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Callable[..., Finished]:
    """Runs a file with the command."""
    monkeypatch.chdir(tmp_path)
    # A process looks once for its workspace, and this one may have looked from elsewhere.
    known_workspace.cache_clear()
    monkeypatch.delenv("PYTHONUNBUFFERED", raising=False)

    def run(text: str, *words: str) -> Finished:
        (tmp_path / "check.py").write_text(_head() + text, encoding="utf-8")
        sys.modules.pop("check", None)
        try:
            code = main(["check.py", *words])
        except SystemExit as end:
            code = int(end.code or 0)
        shown = capsys.readouterr()
        return Finished([], code, shown.out, shown.err)

    return run


def _pytest(folder: Path, text: str, *more: str) -> Finished:
    (folder / "check.py").write_text(_head() + text, encoding="utf-8")
    return subprocess.run(
        [sys.executable, *_PYTEST, *more],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=stretched(),
        check=False,
    )


def test_each_value_has_its_launch_and_its_tests(
    launch_test: Callable[..., Finished], tmp_path: Path
) -> None:
    unmarked = _TWO_RUNS.replace("@pytest.mark.launch_test\n", "")
    ran = launch_test(unmarked, "--junit-xml", "report.xml", "--package-name", "pkg")
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "Starting test run pkg.check.launch_tests[two]" in ran.stdout
    root = ET.parse(tmp_path / "report.xml").getroot()
    counts = {name: root.get(name) for name in ("tests", "failures", "errors")}
    assert counts == {"tests": "12", "failures": "0", "errors": "0"}
    names = {case.get("name") for case in root.iter("testcase")}
    assert {"test_output[one]", "test_order[two]"} <= names


def test_pytest_runs_marked_files(tmp_path: Path) -> None:
    failing = _TWO_RUNS.replace('checker.assertInStdout("end', 'checker.assertInStdout("never')
    (tmp_path / "good.py").write_text(_head() + _TWO_RUNS, encoding="utf-8")
    ran = _pytest(tmp_path, failing, "good.py")
    assert ran.returncode == 1
    assert "1 failed, 1 passed" in ran.stdout, ran.stdout + ran.stderr
    assert "FAIL: check.Behind.test_order[one]" in ran.stdout
    assert "'never one' not found in sequence after previous match" in ran.stdout


_COMPILED = """
from launch_ros.actions import Node

def generate_test_description():
    return launch.LaunchDescription([echo("word"), ReadyToTest()])

class Beside(unittest.TestCase):
    def test_it(self, launch_service, proc_info, proc_output):
        node = Node(package="demo", executable="speak")
        with launch_testing.tools.launch_process(
            launch_service, node, proc_info, proc_output
        ):
            with self.assertRaisesRegex(AssertionError, "there is no such program here"):
                proc_info.assertWaitForShutdown(process=node, timeout=PATIENCE_S)
"""


def test_a_node_that_does_not_compile_is_not_waited_for(
    launch_test: Callable[..., Finished],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    request: pytest.FixtureRequest,
    free_port: int,
) -> None:
    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    request.addfinalizer(drop_graph)
    (tmp_path / "demo").mkdir()
    (tmp_path / "demo/package.xml").write_text(
        "<package format='3'><name>demo</name><version>1.0.0</version><description>d</description>"
        "<maintainer email='a@b.org'>a</maintainer><license>MIT</license></package>"
    )
    (tmp_path / "demo/CMakeLists.txt").write_text("add_executable(speak src/speak.cpp)\n")
    (tmp_path / "demo/src").mkdir()
    (tmp_path / "demo/src/speak.cpp").write_text("int main() { return nowhere; }\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    ran = launch_test(_COMPILED)
    assert ran.returncode == 0, ran.stdout + ran.stderr


_ARGUMENTS = """
def generate_test_description():
    return launch.LaunchDescription([
        DeclareLaunchArgument("word", default_value="default", description="what is said"),
        LogInfo(msg=LaunchConfiguration("word")),
        launch_testing.util.KeepAliveProc(),
        ReadyToTest(),
    ])
class Beside(unittest.TestCase):
    def test_arguments(self, test_args):
        self.assertEqual(test_args, {"word": "given"})
        self.assertEqual(self.test_args, test_args)
"""


def test_launch_arguments_reach_launch_and_tests(launch_test: Callable[..., Finished]) -> None:
    ran = launch_test(_ARGUMENTS, "word:=given")
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "[INFO] [launch.user]: given" in ran.stdout
    shown = launch_test(_ARGUMENTS, "--show-args")
    assert "    'word':\n        what is said\n        (default: 'default')" in shown.stdout
    wrong = launch_test(_ARGUMENTS, "word=given")
    assert wrong.returncode == 2
    assert "malformed launch argument 'word=given'" in wrong.stderr


_DEAD = """
def generate_test_description():
    process = ExecuteProcess(cmd=[sys.executable, "-c", "print('oh no'); raise SystemExit(3)"])
    return launch.LaunchDescription([process, {after}])
import threading
goes_on = threading.Event()
class Beside(unittest.TestCase):
    def test_nothing(self):
        goes_on.wait(PATIENCE_S)
"""


def test_a_launch_that_ends_too_soon_fails(launch_test: Callable[..., Finished]) -> None:
    ran = launch_test(_DEAD.replace("{after}", "ReadyToTest()"))
    assert ran.returncode == 1
    assert "Processes under test stopped before tests completed" in ran.stdout
    assert "exited with 3" in ran.stdout
    assert "oh no" in ran.stdout


_ENDED_BY_A_TEST = """
import os, pathlib, threading
from tests.patience import eventually
END = "import sys; open('over').read(); sys.exit(int(sys.argv[1]))"
os.mkfifo("over")
def generate_test_description():
    process = ExecuteProcess(cmd=[sys.executable, "-c", END, "{code}"])
    return launch.LaunchDescription([process, ReadyToTest()]), {{"process": process}}
class Beside(unittest.TestCase):
    def test_a(self):
        pass
    def test_b(self, proc_info, process, launch_service):
        # Its end is not told before the test waits for it.
        with proc_info.proc_event:
            pathlib.Path("over").write_text("now")
            {wait}
"""


def test_a_launch_that_ends_behind_the_first_of_two_tests_fails(
    launch_test: Callable[..., Finished],
) -> None:
    ran = launch_test(
        _ENDED_BY_A_TEST.format(code=3, wait="pass\n        threading.Event().wait(PATIENCE_S)")
    )
    assert ran.returncode == 1, ran.stderr
    assert "exited with 3" in ran.stdout


def test_a_test_that_waits_for_the_last_end_may_end_after_it(
    launch_test: Callable[..., Finished],
) -> None:
    wait = """proc_info.assertWaitForShutdown(process, timeout=PATIENCE_S)
        eventually(lambda: launch_service.event_loop is None)"""
    ran = launch_test(_ENDED_BY_A_TEST.format(code=0, wait=wait))
    assert ran.returncode == 0, ran.stdout + ran.stderr


def test_a_test_that_outlives_its_launch_says_nothing_more(
    launch_test: Callable[..., Finished], capsys: pytest.CaptureFixture[str]
) -> None:
    before = set(threading.enumerate())
    launch_test(_DEAD.replace("{after}", "ReadyToTest()"))
    sys.modules["check"].goes_on.set()
    for thread in set(threading.enumerate()) - before:
        if thread.name == "test_runner_thread":
            thread.join(stretched())
    assert tuple(capsys.readouterr()) == ("", "")


def test_a_launch_that_is_never_ready_fails(launch_test: Callable[..., Finished]) -> None:
    late = "@launch_testing.ready_to_test_action_timeout(0.2)\ndef generate"
    text = _DEAD.replace("def generate", late)
    later = "TimerAction(period=30.0, actions=[ReadyToTest()])"
    ran = launch_test(text.replace("{after}", later))
    assert ran.returncode == 1
    assert "Timed out waiting for processes to start up" in ran.stdout


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is missing generate_test_description function"),
        (
            "def generate_test_description(): return launch.LaunchDescription()",
            "must return a LaunchDescription containing a ReadyToTest action",
        ),
        (
            "def generate_test_description(x): return launch.LaunchDescription([ReadyToTest()])",
            "generate_test_description has unexpected extra argument 'x'",
        ),
        (
            "@launch_testing.parametrize('y', [1])\ndef generate_test_description(): pass",
            "Could not find an argument in generate_test_description matching prametrized",
        ),
        ("raise ValueError('mine')", "mine"),
    ],
)
def test_wrong_files(text: str, message: str, launch_test: Callable[..., Finished]) -> None:
    ran = launch_test(text)
    assert ran.returncode == 2
    assert message in ran.stderr


def test_the_line_of_an_error_is_told(launch_test: Callable[..., Finished]) -> None:
    ran = launch_test("raise ValueError('mine')")
    line = _head().count("\n") + 1
    assert f"check.py:{line}: mine" in ran.stderr


_KEPT = """
@launch_testing.markers.keep_alive
def generate_test_description(ready_fn):
    return launch.LaunchDescription([OpaqueFunction(function=lambda context: ready_fn())])
class Beside(unittest.TestCase):
    attempts = 0
    @launch_testing.markers.retry_on_failure(times=3, delay=0.01)
    def test_flaky(self):
        type(self).attempts += 1
        self.assertEqual(self.attempts, 3)
    def test_skipped(self):
        self.skipTest("not today")
"""


def test_markers_and_the_way_of_foxy(launch_test: Callable[..., Finished]) -> None:
    ran = launch_test(_KEPT)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "skipped 'not today'" in ran.stdout


def test_a_skipped_launch_is_no_failure(launch_test: Callable[..., Finished]) -> None:
    text = "def generate_test_description(): raise unittest.SkipTest('no GPU')"
    ran = launch_test(text)
    assert (ran.returncode, "is skipped: no GPU" in ran.stdout) == (0, True)


_OWN_PROGRAMS = """
def generate_test_description():
    tests = [
        launch_testing.actions.GTest(path="true"),
        launch_testing.actions.PyTest(path="--version", output="screen"),
        launch_testing.actions.Test(cmd=["sleep", "60"], timeout=0.3),
    ]
    ready = launch_testing.event_handlers.StdoutReadyListener(
        target_action=tests[1], ready_txt="pytest", actions=[ReadyToTest()]
    )
    return launch.LaunchDescription([RegisterEventHandler(ready), *tests]), {"tests": tests}
class Beside(unittest.TestCase):
    def test_all_end(self, proc_info, tests):
        for one in tests:
            proc_info.assertWaitForShutdown(one, timeout=PATIENCE_S)
@launch_testing.post_shutdown_test()
class Behind(unittest.TestCase):
    def test_codes(self, proc_info, tests):
        self.assertEqual([proc_info[one].returncode for one in tests], [0, 0, -2])
"""


def test_programs_that_test_something(launch_test: Callable[..., Finished]) -> None:
    ran = launch_test(_OWN_PROGRAMS)
    assert ran.returncode == 0, ran.stdout + ran.stderr


def test_drop_in_has_the_paths_of_ros() -> None:
    code = (
        "import launch_testing.pytest.hooks, launch_testing.tools.text\n"
        "import launch_testing.test_runner, launch_testing.util\n"
        "from launch_testing.util import KeepAliveProc, resolveProcesses\n"
        "from launch_testing.asserts import EXIT_SIGINT, assertInStderr\n"
        "from launch_testing.io_handler import ActiveIoHandler\n"
        "print(EXIT_SIGINT, launch_testing.util.NO_CMD_ARGS is not None)"
    )
    environment = {**os.environ, "PYTHONPATH": str(drop_in_folder())}
    ran = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False
    )
    assert ran.stdout == "130 True\n", ran.stderr


def test_drop_in_is_there_without_pytest() -> None:
    code = (
        "import sys; sys.modules['pytest'] = None\n"
        "import launch_testing.actions\n"
        "print(launch_testing.actions.ReadyToTest.__name__)"
    )
    environment = {**os.environ, "PYTHONPATH": str(drop_in_folder())}
    ran = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False
    )
    assert ran.stdout == "ReadyToTest\n", ran.stderr
