"""Carries out requests of services and says what came of them."""

from __future__ import annotations

from collections.abc import Callable

from gazelle.control.controller_manager.controller_manager import ControllerManager
from gazelle.control.controller_node_interface import Ports
from gazelle.control.errors import ControllerError
from gazelle.diagnostics import Diagnostic, Severity, brief

__all__ = ["Actor"]

_LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warn", Severity.INFO: "info"}
_LISTED = "`gazelle doctor` on the package or launch"


class Actor:
    """Logs failures, and findings about parameters that came up on the way."""

    def __init__(self, manager: ControllerManager, ports: Ports) -> None:
        self._manager = manager
        self._ports = ports

    def attempt(self, action: Callable[[], object]) -> str:
        """Do something; return why it failed, empty when it did not."""
        diagnostics = self._manager.diagnostics
        known = len(diagnostics)
        try:
            action()
            return ""
        except ControllerError as error:
            return str(error)
        finally:
            # Failures of running controllers have been logged by themselves.
            new = [item for item in list(diagnostics)[known:]
                   if item.code != "control.controller-failed"]  # fmt: skip
            for item in brief(new, _LISTED).shown:
                self._ports.log(_LEVELS[item.severity], _line(item))

    def done(self, action: Callable[[], object]) -> bool:
        """Do something; a failure is logged and gives False."""
        reason = self.attempt(action)
        if reason:
            self._ports.log("error", reason)
        return not reason


def _line(item: Diagnostic) -> str:
    place = f"{item.span}: " if item.span is not None else ""
    fix = f" (fix: {item.fix})" if item.fix else ""
    return f"{place}{item.message} [{item.code}]{fix}"
