"""Makes a user's class a controller, and finds where in it an error arose."""

from __future__ import annotations

import inspect
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.python_controllers.controller_api import (
    ControlPeriod,
    ControlTime,
    UserNode,
    UserRobot,
)
from gazelle.diagnostics import SourceSpan
from gazelle.parameters import ParameterTable

__all__ = ["PythonController", "adapted", "error_span", "error_text", "located"]


def located(error: BaseException, folder: Path) -> str:
    """Return an error in words, with file and line of the last frame below a folder."""
    span = error_span(error, folder)
    place = "" if span is None else f"{span.file}:{span.line}"
    text = error_text(error, folder)
    return f"{place} {text}" if text.startswith("in ") else f"{place}: {text}" if place else text


def error_text(error: BaseException, folder: Path) -> str:
    """Return an error in words, with the function of the last frame below a folder."""
    text = f"{type(error).__name__}: {error}"
    last = _last_frame(error, folder)
    return text if last is None else f"in {last.name}(): {text}"


def error_span(error: BaseException, folder: Path) -> SourceSpan | None:
    """Return the line below a folder that an error came from; None when there is none."""
    if isinstance(error, SyntaxError) and error.filename:
        return SourceSpan(error.filename, error.lineno or 0, error.offset or 0)
    last = _last_frame(error, folder)
    if last is None:
        return None
    begin, end = last.colno or 0, last.end_colno or 0
    is_one_line = last.end_lineno == last.lineno
    length = end - begin if is_one_line else 0
    return SourceSpan(last.filename, last.lineno or 0, begin + 1, length)


def _last_frame(error: BaseException, folder: Path) -> traceback.FrameSummary | None:
    if isinstance(error, SyntaxError) and error.filename:
        return None
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if Path(frame.filename).is_relative_to(folder)]
    return own[-1] if own else None


_ARGUMENTS = {
    "init": "robot and node",
    "starting": "time",
    "update": "time and period",
    "stopping": "time",
}


class PythonController(Controller):
    """Runs an object of a user's class.

    The class has ``init(robot, node)``, ``starting(time)``, ``update(time, period)`` and
    ``stopping(time)``; all but ``update`` may be left out, and PR2's forms without arguments are
    understood. ``init`` may return False to refuse. A class attribute ``command_interfaces``
    names interfaces to claim, such as ``("wheel/velocity",)``; otherwise the joints that ``init``
    takes are claimed by effort, or by the first interface they have.

    Attributes:
        USER_CLASS: the user's class.
        FOLDER: its package, for places in errors.
        user: the object.
    """

    TABLE: ClassVar[ControllerTable] = ControllerTable(
        ParameterTable(
            "python",
            "A Python class of the user's own.",
            (),
        ),
        interfaces="what init() takes",
    )
    has_table: ClassVar[bool] = False
    USER_CLASS: ClassVar[type]
    FOLDER: ClassVar[Path]

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._now_ns = 0
        wishes = tuple(getattr(self.USER_CLASS, "command_interfaces", ()))
        robot = UserRobot(context, wishes, lambda: self._now_ns)
        node = UserNode(context, lambda: self._now_ns)
        self.user: Any = self._guarded("__init__", self.USER_CLASS)
        if not callable(getattr(self.user, "update", None)):
            name = self.USER_CLASS.__name__
            raise ControllerError(f"controller class '{name}' has no update(time, period)")
        init = self._method("init", 2)
        if self._guarded("init", lambda: init(robot, node)) is False:
            text = f"Initializing controller '{context.name}' failed: init() of class "
            raise ControllerError(f"{text}'{self.USER_CLASS.__name__}' returned False")
        self.commands, self.states = robot.close_claims()
        self._starting = self._method("starting", 1)
        self._update = self._method("update", 2)
        self._stopping = self._method("stopping", 1)

    def start(self, time_ns: int) -> None:
        """Call ``starting``."""
        self._now_ns = time_ns
        self._guarded("starting", lambda: self._starting(ControlTime.of(time_ns)))

    def update(self, time_ns: int, period_ns: int) -> None:
        """Call ``update``."""
        self._now_ns = time_ns
        try:
            self._update(ControlTime.of(time_ns), ControlPeriod.of(period_ns))
        except Exception as error:
            raise ControllerError(located(error, self.FOLDER)) from error

    def stop(self, time_ns: int) -> None:
        """Call ``stopping``."""
        self._now_ns = time_ns
        self._guarded("stopping", lambda: self._stopping(ControlTime.of(time_ns)))

    def _guarded(self, name: str, action: Callable[[], Any]) -> Any:
        try:
            return action()
        except Exception as error:
            text = f"{name}() of controller class '{self.USER_CLASS.__name__}' failed: "
            raise ControllerError(text + located(error, self.FOLDER)) from error

    def _method(self, name: str, count: int) -> Callable[..., Any]:
        """Return a method that takes as many arguments as it is given; PR2's take none."""
        method = getattr(self.user, name, None)
        if method is None:
            return lambda *arguments: None
        try:
            inspect.signature(method).bind(*range(count))
        except TypeError:
            taken = len(inspect.signature(method).parameters)
            if taken == 0:
                return lambda *arguments: method()
            raise ControllerError(
                f"{name}() of controller class '{self.USER_CLASS.__name__}' takes {taken} "
                f"arguments, but is called with {_ARGUMENTS[name]}"
            ) from None
        found: Callable[..., Any] = method
        return found


def adapted(user_class: type, type_name: str, folder: Path) -> type[Controller]:
    """Return the controller class of a user's class.

    Raises:
        ControllerError: it is not a class.
    """
    if not inspect.isclass(user_class):
        raise ControllerError(f"controller type '{type_name}': {user_class!r} is not a class")
    attributes = {"USER_CLASS": user_class, "FOLDER": folder}
    return type(user_class.__name__, (PythonController,), attributes)
