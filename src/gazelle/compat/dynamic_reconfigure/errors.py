"""Exceptions of dynamic_reconfigure; rqt and user programs know them by these names."""

from __future__ import annotations

__all__ = [
    "DynamicReconfigureCallbackException",
    "DynamicReconfigureException",
    "DynamicReconfigureParameterException",
]


class DynamicReconfigureException(Exception):  # noqa: N818 - the original's name
    """Base of the others."""


class DynamicReconfigureParameterException(DynamicReconfigureException):
    """A parameter is unknown, or a value does not fit."""


class DynamicReconfigureCallbackException(DynamicReconfigureException):
    """The node's callback failed, or its server could not be called."""
