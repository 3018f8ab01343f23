"""launch_pytest: launches as fixtures of pytest, and tests that run in the launch's loop.

`gazelle.testing.launch_testing_plugin` registers this when it meets the first file that names
launch_pytest, so its fixtures are in nobody else's way.
"""

from __future__ import annotations

import asyncio
import inspect
from collections.abc import Callable, Generator, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import pytest

from gazelle.launch.ros2 import LaunchContext, LaunchDescription, LaunchService
from gazelle.launch.ros2.launch_testing.actions import ReadyToTest
from gazelle.launch.ros2.launch_testing.loader import ready_actions

__all__ = ["event_loop", "fixture", "launch_context", "launch_service"]

_RECORD = "_launch_pytest_fixture"
_WRONG_VALUE = "has to return a launch description, or a sequence that begins with one"


def fixture(
    decorated: Callable[..., Any] | None = None,
    *,
    shutdown_when_idle: bool = True,
    auto_shutdown: bool = True,
    **kwargs: Any,
) -> Any:
    """Make a fixture of a function that returns a launch description; it is launched.

    Args:
        decorated: the function.
        shutdown_when_idle: the launch ends when it has nothing more to do.
        auto_shutdown: the launch is ended behind the tests; else it has to end by itself.
        **kwargs: what ``pytest.fixture`` takes.
    """

    def decorate(function: Callable[..., Any]) -> Any:
        scope = str(kwargs.get("scope", "function"))
        record = _Fixture(shutdown_when_idle, auto_shutdown, scope)
        made = pytest.fixture(**kwargs)(function)
        for one in (function, made):  # what pytest calls, and what tests name in their marker
            setattr(one, _RECORD, record)
        return made

    return decorate if decorated is None else decorate(decorated)


@dataclass
class _Fixture:
    """A launch fixture.

    Attributes:
        shutdown_when_idle, auto_shutdown: as `fixture` has them.
        scope: of the fixture.
        launch: which it has made last.
    """

    shutdown_when_idle: bool
    auto_shutdown: bool
    scope: str
    launch: _Launch | None = None


class _Launch:
    """A launch that runs whenever its loop does.

    Attributes:
        loop: its event loop.
        service: its service.
    """

    def __init__(self, name: str, made_by: _Fixture) -> None:
        self.loop = asyncio.new_event_loop()
        self.service = LaunchService()
        self._name = name
        self._shutdown_when_idle = made_by.shutdown_when_idle
        self._auto_shutdown = made_by.auto_shutdown
        self._task: asyncio.Task[int] | None = None
        self._code: int | None = None

    def begin(self, value: Any) -> None:
        """Launch what a fixture returned, until it is ready."""
        description = value[0] if isinstance(value, Sequence) and value else value
        if not isinstance(description, LaunchDescription):
            pytest.fail(f"launch_pytest fixture '{self._name}' {_WRONG_VALUE}", pytrace=False)
        ready = self.loop.create_future()
        self._ready_action(description)._add_callback(
            lambda: None if ready.done() else ready.set_result(None)
        )
        self.service.include_launch_description(description)
        run = self.service.run_async(shutdown_when_idle=self._shutdown_when_idle)
        self._task = self.loop.create_task(run)
        both = asyncio.wait({ready, self._task}, return_when=asyncio.FIRST_COMPLETED)
        self.loop.run_until_complete(both)
        if not ready.done():
            pytest.fail(f"the launch of '{self._name}' ended before it was ready", pytrace=False)

    def _ready_action(self, description: LaunchDescription) -> ReadyToTest:
        found = list(ready_actions(description.entities))
        if len(found) > 1:
            raise RuntimeError(
                "launch_pytest fixtures must return a LaunchDescription containing only one "
                "ReadyToTest action"
            )
        if not found:
            found = [ReadyToTest()]
            description.add_action(found[0])
        return found[0]

    def end(self) -> None:
        """End the launch, or wait until it does by itself."""
        if self._task is None or self._code is not None:
            return
        if self._auto_shutdown:
            self.service.shutdown()
        self._code = self.loop.run_until_complete(self._task)
        assert self._code == 0, f"launch service of '{self._name}' failed, code {self._code}"

    def close(self) -> None:
        """End the launch and its loop."""
        try:
            self.end()
        finally:
            self.loop.close()


@pytest.fixture
def launch_service(request: pytest.FixtureRequest) -> LaunchService:
    """The service of the test's launch."""
    return _launch_of(request).service


@pytest.fixture
def launch_context(request: pytest.FixtureRequest) -> LaunchContext:
    """The context of the test's launch."""
    return _launch_of(request).service.context


@pytest.fixture
def event_loop(request: pytest.FixtureRequest) -> asyncio.AbstractEventLoop:
    """The event loop of the test's launch."""
    return _launch_of(request).loop


def pytest_configure(config: pytest.Config) -> None:
    """Make the marker known."""
    text = "mark the test as a launch test, run with the launch of a launch_pytest fixture"
    config.addinivalue_line("markers", f"launch(fixture, shutdown=False): {text}")


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_fixture_setup(fixturedef: Any, request: Any) -> Generator[None, Any, Any]:
    """Launch what a launch fixture returns."""
    value = yield
    record: _Fixture | None = getattr(fixturedef.func, _RECORD, None)
    if record is not None:
        record.launch = launch = _Launch(fixturedef.argname, record)
        fixturedef.addfinalizer(launch.close)
        launch.begin(value)
    return value


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makeitem(collector: Any, name: str, obj: Any) -> Any:
    """Let launch tests yield, which pytest refuses in tests: behind it the launch is over."""
    is_launch_test = any(mark.name == "launch" for mark in getattr(obj, "pytestmark", []))
    yields = inspect.isgeneratorfunction(obj) or inspect.isasyncgenfunction(obj)
    if is_launch_test and yields and collector.funcnamefilter(name):
        return list(collector._genfunctions(name, obj))
    return None


def pytest_itemcollected(item: pytest.Item) -> None:
    """Let launch tests have their launch, whether they name it or not."""
    name = _fixture_name(item)
    if name and isinstance(item, pytest.Function) and name not in item.fixturenames:
        item.fixturenames.insert(0, name)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put tests that come behind the launch's end behind its others."""

    def sort_key(item: pytest.Item) -> tuple[int, bool]:
        key = (str(item.path), _fixture_name(item))
        return first.setdefault(key, len(first)) if key[1] else -1, _is_behind(item)

    first: dict[tuple[str, str], int] = {}
    records = [(one, _record_of(one)) for one in items]
    wide = [one for one, record in records if record is not None and record.scope != "function"]
    ordered = iter(sorted(wide, key=sort_key))
    chosen = {id(one) for one in wide}
    items[:] = [next(ordered) if id(one) in chosen else one for one in items]


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: Any) -> bool | None:
    """Run a launch test while the loop of its launch runs."""
    name = _fixture_name(pyfuncitem)
    if not name and pyfuncitem.get_closest_marker("launch") is not None:
        text = '"fixture" keyword argument is required in a pytest.mark.launch() decorator'
        pytest.fail(text, pytrace=False)
    if not name:
        return None
    launch = _made(pyfuncitem)
    names = pyfuncitem._fixtureinfo.argnames
    arguments = {one: pyfuncitem.funcargs[one] for one in names}
    if _is_behind(pyfuncitem):
        launch.end()
    for part in _parts(pyfuncitem.obj, arguments, launch):
        launch.loop.run_until_complete(part)
    return True


def _parts(function: Any, arguments: dict[str, Any], launch: _Launch) -> Iterator[Any]:
    """Yield what is to be awaited: a test, or its parts before and behind the launch's end."""
    if inspect.iscoroutinefunction(function):
        yield function(**arguments)
    elif inspect.isasyncgenfunction(function):
        steps = function(**arguments)
        yield anext(steps)
        launch.end()
        yield _ends(anext(steps, _END))
    elif inspect.isgeneratorfunction(function):
        later = function(**arguments)
        yield launch.loop.run_in_executor(None, next, later)
        launch.end()
        yield _ends(launch.loop.run_in_executor(None, next, later, _END))
    else:
        yield launch.loop.run_in_executor(None, lambda: function(**arguments))


_END = object()


async def _ends(step: Any) -> None:
    if await step is not _END:
        pytest.fail("launch tests must stop iteration after yielding once", pytrace=False)


def _fixture_name(item: pytest.Item) -> str:
    mark = item.get_closest_marker("launch")
    found = None if mark is None else mark.kwargs.get("fixture")
    return str(getattr(found, "__name__", "")) if found is not None else ""


def _record_of(item: pytest.Item) -> _Fixture | None:
    mark = item.get_closest_marker("launch")
    return None if mark is None else getattr(mark.kwargs.get("fixture"), _RECORD, None)


def _made(item: pytest.Item) -> _Launch:
    record = _record_of(item)
    if record is None or record.launch is None:
        text = f"'{_fixture_name(item)}' is no fixture of launch_pytest that was set up"
        pytest.fail(text, pytrace=False)
    return record.launch


def _is_behind(item: pytest.Item) -> bool:
    mark = item.get_closest_marker("launch")
    return mark is not None and bool(mark.kwargs.get("shutdown", False))


def _launch_of(request: pytest.FixtureRequest) -> _Launch:
    name = _fixture_name(request.node)
    if not name:
        pytest.fail("only tests with @pytest.mark.launch(fixture=…) have a launch", pytrace=False)
    request.getfixturevalue(name)
    return _made(request.node)
