"""Finding launch tests in a module."""

from __future__ import annotations

import functools
import inspect
import unittest
from collections.abc import Callable, Iterable, Iterator, Mapping
from types import ModuleType
from typing import Any

from gazelle.launch.ros2.launch_description import LaunchDescription
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.launch_testing.actions import ReadyToTest

__all__ = [
    "LoadTestsFromPythonModule",
    "PostShutdownTestLoader",
    "PreShutdownTestLoader",
    "TestRun",
    "ready_actions",
]

_PATIENCE_S = 15


class TestRun:
    """One launch with its tests.

    Attributes:
        name: of the run.
        param_args: the values of ``parametrize``.
        pre_shutdown_tests: run beside the launch.
        post_shutdown_tests: run when it is over.
        timeout: seconds that ReadyToTest may take.
    """

    __test__ = False

    def __init__(
        self,
        name: str,
        test_description_function: Callable[..., Any],
        param_args: Mapping[str, Any],
        pre_shutdown_tests: unittest.TestSuite,
        post_shutdown_tests: unittest.TestSuite,
    ) -> None:
        self.name = name
        self.param_args = dict(param_args)
        self.pre_shutdown_tests = pre_shutdown_tests
        self.post_shutdown_tests = post_shutdown_tests
        self.timeout: float = getattr(
            test_description_function, "__ready_to_test_action_timeout__", _PATIENCE_S
        )
        self._test_description_function = test_description_function
        # A suite forgets the tests that have run.
        self._all_cases = (*_cases(pre_shutdown_tests), *_cases(post_shutdown_tests))
        if self.param_args:
            self._rename_cases()

    @property
    def markers(self) -> dict[str, Any]:
        """What decorators said about the launch."""
        return getattr(self._test_description_function, "__markers__", {})

    def normalized_test_description(
        self, ready_fn: Callable[[], object]
    ) -> tuple[LaunchDescription, dict[str, Any]]:
        """Return the description, and what the user wants tests to know of it.

        Args:
            ready_fn: is called when tests may begin; given to functions that ask for it (Foxy's
                way), else to the description's ReadyToTest.

        Raises:
            Exception: there is no ReadyToTest in it.
        """
        function = self._test_description_function
        takes_it = "ready_fn" in inspect.signature(function).parameters
        found = function(ready_fn=ready_fn) if takes_it else function()
        description, known = found if isinstance(found, tuple) else (found, {})
        ready = next(ready_actions(description.entities), None)
        if ready is not None:
            ready._add_callback(ready_fn)
        elif not takes_it:
            raise Exception(
                "generate_test_description functions must return a LaunchDescription "
                "containing a ReadyToTest action"
            )
        return description, known

    def get_launch_description(self) -> LaunchDescription:
        """Return the description."""
        return self.normalized_test_description(ready_fn=lambda: None)[0]

    def bind(
        self,
        tests: unittest.TestSuite,
        injected_attributes: Mapping[str, Any] | None = None,
        injected_args: Mapping[str, Any] | None = None,
    ) -> None:
        """Give tests what their methods ask for by the names of arguments."""
        cases = list(_cases(tests))
        classes = dict.fromkeys(type(case) for case in cases)
        for kind in classes:
            for name, value in (injected_attributes or {}).items():
                setattr(kind, name, value)
        for owner, names in [
            *((case, (case._testMethodName, "setUp", "tearDown")) for case in cases),
            *((kind, ("setUpClass", "tearDownClass")) for kind in classes),
        ]:
            for name in names:
                setattr(owner, name, _bound(getattr(owner, name), injected_args or {}))

    def all_cases(self) -> Iterator[unittest.TestCase]:
        """Yield every test."""
        yield from self._all_cases

    def __str__(self) -> str:
        return self.name + self._values()

    def _values(self) -> str:
        return f"[{', '.join(map(str, self.param_args.values()))}]" if self.param_args else ""

    def _rename_cases(self) -> None:
        for case in self.all_cases():
            method = getattr(case, case._testMethodName)
            name = case._testMethodName + self._values()
            setattr(case, name, method)
            case._testMethodName = name


def LoadTestsFromPythonModule(module: ModuleType, *, name: str = "launch_tests") -> list[TestRun]:
    """Return the runs of a module with a ``generate_test_description``."""
    function = module.generate_test_description
    runs: Iterable[tuple[Any, dict[str, Any]]] = [(function, {})]
    if hasattr(function, "__parametrized__"):
        runs = function()
    return [
        TestRun(
            name,
            description,
            arguments,
            PreShutdownTestLoader().loadTestsFromModule(module),
            PostShutdownTestLoader().loadTestsFromModule(module),
        )
        for description, arguments in runs
    ]


def PreShutdownTestLoader() -> unittest.TestLoader:
    """Return a loader of the tests that run beside the launch."""
    return _Loader(after_shutdown=False)


def PostShutdownTestLoader() -> unittest.TestLoader:
    """Return a loader of the tests that run when it is over."""
    return _Loader(after_shutdown=True)


class _Loader(unittest.TestLoader):
    def __init__(self, *, after_shutdown: bool) -> None:
        super().__init__()
        self._after_shutdown = after_shutdown

    def loadTestsFromTestCase(self, testCaseClass: type[unittest.TestCase]) -> unittest.TestSuite:
        if getattr(testCaseClass, "__post_shutdown_test__", False) != self._after_shutdown:
            return unittest.TestSuite()
        # Each run binds its own values to its own class.
        members = {"__module__": testCaseClass.__module__}
        own = type(testCaseClass.__name__, (testCaseClass,), members)
        return super().loadTestsFromTestCase(own)


def ready_actions(entities: Iterable[LaunchDescriptionEntity]) -> Iterator[ReadyToTest]:
    """Yield every ReadyToTest in entities and in what they are known to yield."""
    for entity in entities:
        if isinstance(entity, ReadyToTest):
            yield entity
        yield from ready_actions(entity.describe_sub_entities())
        for _condition, inner in entity.describe_conditional_sub_entities():
            yield from ready_actions(inner)


def _cases(suite: Any) -> Iterator[unittest.TestCase]:
    if isinstance(suite, unittest.TestCase):
        yield suite
        return
    for one in suite:
        yield from _cases(one)


def _bound(method: Callable[..., Any], candidates: Mapping[str, Any]) -> Callable[..., Any]:
    wanted = inspect.signature(method).parameters
    found = {name: value for name, value in candidates.items() if name in wanted}
    return functools.partial(method, **found) if found else method
