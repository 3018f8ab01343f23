"""Why a transform cannot be had; the texts are tf2's."""

from __future__ import annotations

from gazelle.errors import GraphError

__all__ = [
    "ConnectivityError",
    "ExtrapolationError",
    "InvalidFrameError",
    "TransformError",
    "UnknownFrameError",
]


class TransformError(GraphError):
    """A transform cannot be had."""


class UnknownFrameError(TransformError):
    """A frame does not exist, or the frames form a loop (tf2: ``LookupException``)."""


class ConnectivityError(TransformError):
    """The frames are in two trees."""


class ExtrapolationError(TransformError):
    """The time asked for is outside what is known."""


class InvalidFrameError(TransformError):
    """A frame's name cannot be one."""
