"""Errors of the control layer."""

from __future__ import annotations

from gazelle.errors import GazelleError

__all__ = ["ControllerError"]


class ControllerError(GazelleError):
    """A controller cannot be loaded, configured, started or stopped; the message says why."""
