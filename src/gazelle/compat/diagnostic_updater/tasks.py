"""Tasks of a node's diagnostics, alone, together and in a list."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle.compat.diagnostic_updater.status import DiagnosticStatusWrapper

__all__ = [
    "CompositeDiagnosticTask",
    "DiagnosticTask",
    "DiagnosticTaskVector",
    "FunctionDiagnosticTask",
]


class DiagnosticTask:
    """Something that is reported on; a program's own tasks have their own `run`."""

    def __init__(self, name: str) -> None:
        self.name = name

    def getName(self) -> str:
        """Return the name."""
        return self.name

    def run(self, stat: Any) -> Any:
        """Fill in a status and return it."""
        return stat


class FunctionDiagnosticTask(DiagnosticTask):
    """A task that is a function of a status."""

    def __init__(self, name: str, fn: Callable[[Any], Any]) -> None:
        super().__init__(name)
        self.fn = fn

    def run(self, stat: Any) -> Any:
        """Let the function fill in a status."""
        return self.fn(stat)


class CompositeDiagnosticTask(DiagnosticTask):
    """Tasks with one status: the worst level, and the messages of what is not OK."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.tasks: list[Any] = []

    def addTask(self, t: Any) -> None:
        """Append a task."""
        self.tasks.append(t)

    def run(self, stat: Any) -> Any:
        """Let each task fill in the status."""
        combined, original = DiagnosticStatusWrapper(), DiagnosticStatusWrapper()
        combined.clearSummary()
        original.summary(stat)
        for task in self.tasks:
            stat.summary(original)
            stat = task.run(stat)
            combined.mergeSummary(stat)
        stat.summary(combined)
        return stat


class DiagnosticTaskVector:
    """Tasks by name."""

    class DiagnosticTaskInternal:
        """A task of the list."""

        def __init__(self, name: str, fn: Callable[[Any], Any]) -> None:
            self.name = name
            self.fn = fn

        def run(self, stat: Any) -> Any:
            """Fill in a status."""
            stat.name = self.name
            return self.fn(stat)

    def __init__(self) -> None:
        self.tasks: list[DiagnosticTaskVector.DiagnosticTaskInternal] = []
        self.lock = threading.Lock()

    def addedTaskCallback(self, task: Any) -> None:
        """Follow up on a new task; classes say how."""

    def add(self, *args: Any) -> None:
        """Append a task, or a function under a name."""
        name, run = args if len(args) == 2 else (args[0].getName(), args[0].run)
        task = DiagnosticTaskVector.DiagnosticTaskInternal(name, run)
        with self.lock:
            self.tasks.append(task)
            self.addedTaskCallback(task)

    def removeByName(self, name: str) -> bool:
        """Remove the first task of a name; False if there is none."""
        with self.lock:
            found = next((task for task in self.tasks if task.name == name), None)
            if found is not None:
                self.tasks.remove(found)
        return found is not None
