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
    """The time asked for is outside what is known.

    Attributes:
        is_past: it lies before everything that is known, so waiting does not help.
    """

    def __init__(self, text: str, *, is_past: bool = False) -> None:
        """Say why."""
        super().__init__(text)
        self.is_past = is_past


class InvalidFrameError(TransformError):
    """A frame's name cannot be one."""
