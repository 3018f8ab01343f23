"""launch_pytest: launches as fixtures, tests beside them and behind their end."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from tests.patience import stretched

_HEAD = """
import sys
import launch, launch_pytest, pytest
from launch_pytest.tools import process as process_tools
from launch.actions import ExecuteProcess
"""
_TESTS = """
@pytest.fixture
def hello():
    words = ['sh', '-c', 'echo hello; echo bad >&2; exec sleep 60']
    return ExecuteProcess(cmd=words, cached_output=True)

@launch_pytest.fixture
def description(hello):
    return launch.LaunchDescription([hello, launch_pytest.actions.ReadyToTest()])

@pytest.mark.launch(fixture=description)
def test_sync(hello, launch_context):
    def check(text): assert text == 'hello\\n', text
    process_tools.assert_output_sync(launch_context, hello, check, timeout=PATIENCE_S)
    bad = lambda text: 'bad' in text
    assert process_tools.wait_for_stderr_sync(launch_context, hello, bad, timeout=PATIENCE_S)
    assert not process_tools.wait_for_exit_sync(launch_context, hello, timeout=0.05)
    yield
    assert hello.return_code == -2

@pytest.mark.launch(fixture=description)
async def test_async(hello, launch_context):
    assert await process_tools.wait_for_start(launch_context, hello, timeout=PATIENCE_S)
    good = lambda text: text == 'hello\\n'
    assert await process_tools.wait_for_output(launch_context, hello, good, timeout=PATIENCE_S)
    with pytest.raises(AssertionError):
        def never(text): assert text == 'x'
        await process_tools.assert_output(launch_context, hello, never, timeout=0.05)

@pytest.mark.launch(fixture=description)
async def test_async_gen(hello):
    yield
    assert hello.return_code is not None

@pytest.mark.launch(fixture=description, shutdown=True)
def test_behind(hello):
    assert hello.return_code is not None

seen = []
@launch_pytest.fixture(scope='module')
def shared():
    return launch.LaunchDescription([ExecuteProcess(cmd=['sleep', '60'])]), 'more'

@pytest.mark.launch(fixture=shared, shutdown=True)
def test_last(shared, launch_service):
    assert seen == [1, 2] and shared[1] == 'more'
    assert launch_service.event_loop is None

@pytest.mark.launch(fixture=shared)
def test_one(launch_service):
    seen.append(1)
    assert launch_service.event_loop is not None

@pytest.mark.launch(fixture=shared)
async def test_two():
    seen.append(2)
"""
_PLUGINS = ("-p", "no:cacheprovider")


def _pytest(folder: Path, text: str) -> str:
    path = folder / "test_it.py"
    path.write_text(f"{_HEAD}\nPATIENCE_S = {stretched()}\n{text}", encoding="utf-8")
    ran = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", *_PLUGINS, path.name],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=stretched(),
        check=False,
    )
    return ran.stdout + ran.stderr


_WRONG = """
@launch_pytest.fixture
def wrong():
    return 3

@launch_pytest.fixture
def short():
    return launch.LaunchDescription([launch.actions.TimerAction(
        period=60.0, actions=[launch_pytest.actions.ReadyToTest()]
    ), launch.actions.Shutdown()])

@launch_pytest.fixture
def right():
    return launch.LaunchDescription()

@pytest.mark.launch(fixture=wrong)
def test_wrong(): pass

@pytest.mark.launch(fixture=short)
def test_short(): pass

@pytest.mark.launch(fixture=right)
def test_twice():
    yield
    yield

def test_none(launch_service): pass

@pytest.mark.launch
def test_unnamed(): pass
"""


def test_launches_are_fixtures_and_mistakes_are_told(tmp_path: Path) -> None:
    text = _pytest(tmp_path, _TESTS + _WRONG)
    for words in (
        "launch_pytest fixture 'wrong' has to return a launch description, or a sequence",
        "the launch of 'short' ended before it was ready",
        "launch tests must stop iteration after yielding once",
        '"fixture" keyword argument is required in a pytest.mark.launch() decorator',
        "only tests with @pytest.mark.launch(fixture=…) have a launch",
    ):
        assert words in text
    assert "2 failed, 7 passed, 3 errors" in text


_OF_MODULE = """
@launch_pytest.fixture(scope='module')
def description():
    return launch.LaunchDescription([ExecuteProcess(cmd=['sleep', '60'])])

@pytest.mark.launch(fixture=description, shutdown=True)
def test_behind(launch_service):
    assert launch_service.event_loop is None

@pytest.mark.launch(fixture=description)
def test_beside(launch_service):
    assert launch_service.event_loop is not None
"""
_OF_EACH = """
@launch_pytest.fixture
def description():
    return launch.LaunchDescription([ExecuteProcess(cmd=['sleep', '60'])])

@pytest.mark.launch(fixture=description)
def test_each(launch_service):
    assert launch_service.event_loop is not None
"""


def test_fixtures_of_one_name_in_two_files_have_their_own_scopes(tmp_path: Path) -> None:
    (tmp_path / "test_a.py").write_text(_HEAD + _OF_MODULE, encoding="utf-8")
    (tmp_path / "test_b.py").write_text(_HEAD + _OF_EACH, encoding="utf-8")
    ran = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", *_PLUGINS, "test_a.py", "test_b.py"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=stretched(),
        check=False,
    )
    assert "3 passed" in ran.stdout, ran.stdout
