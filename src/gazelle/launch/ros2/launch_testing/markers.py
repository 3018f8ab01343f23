"""Decorators of launch tests."""

from __future__ import annotations

import functools
import inspect
import time
import unittest
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

__all__ = [
    "keep_alive",
    "parametrize",
    "post_shutdown_test",
    "ready_to_test_action_timeout",
    "retry_on_failure",
]

_Thing = TypeVar("_Thing")


def post_shutdown_test() -> Callable[[_Thing], _Thing]:
    """Let the tests of a class run when the launch is over.

    Raises:
        TypeError: it decorates no class.
    """

    def decorate(test_item: _Thing) -> _Thing:
        if not isinstance(test_item, type):
            raise TypeError("postcondition_test should decorate test classes")
        test_item.__post_shutdown_test__ = True  # type: ignore[attr-defined]
        return test_item

    return decorate


def keep_alive(test_description: _Thing) -> _Thing:
    """Let the launch go on though it has nothing to do."""
    markers = getattr(test_description, "__markers__", None)
    if markers is None:
        markers = test_description.__markers__ = {}  # type: ignore[attr-defined]
    markers["keep_alive"] = True
    return test_description


def ready_to_test_action_timeout(timeout: float) -> Callable[[_Thing], _Thing]:
    """Wait so many seconds for ReadyToTest, instead of 15."""

    def decorate(func: _Thing) -> _Thing:
        func.__ready_to_test_action_timeout__ = timeout  # type: ignore[attr-defined]
        return func

    return decorate


def parametrize(argnames: str, argvalues: Iterable[Any]) -> Callable[[Any], Any]:
    """Launch once for each value, as pytest's decorator of this name does."""
    names = [name.strip() for name in argnames.split(",") if name.strip()]
    rows = [value if isinstance(value, tuple) else (value,) for value in argvalues]

    def decorate(func: Any) -> Any:
        @functools.wraps(func)
        def runs() -> Iterator[tuple[Any, dict[str, Any]]]:
            for row in rows:
                arguments = dict(zip(names, row, strict=False))
                bound: Any = functools.partial(func, **arguments)
                yield functools.update_wrapper(bound, func), arguments

        runs.__parametrized__ = True  # type: ignore[attr-defined]
        return runs

    return decorate


def retry_on_failure(*, times: int, delay: float | None = None) -> Callable[[Any], Any]:
    """Run a test up to so many times, with so many seconds between, until it passes."""
    assert times > 0

    def decorate(func: Any) -> Any:
        assert next(iter(inspect.signature(func).parameters), "") == "self"

        @functools.wraps(func)
        def test(self: Any, *args: Any, **kwargs: Any) -> Any:
            for _ in range(times - 1):
                try:
                    found = func(self, *args, **kwargs)
                    if isinstance(self, unittest.TestCase):
                        assert _outcome(self).success
                    return found
                except AssertionError:
                    _forget_failures(self)
                if delay is not None:
                    time.sleep(delay)
            return func(self, *args, **kwargs)

        return test

    return decorate


def _outcome(case: Any) -> Any:
    return case._outcome


def _forget_failures(case: Any) -> None:
    """Let a subtest that failed not count."""
    outcome = getattr(case, "_outcome", None)
    if outcome is None:
        return
    if getattr(outcome, "result", None) is not None:
        outcome.result.errors.clear()
    outcome.success = True
