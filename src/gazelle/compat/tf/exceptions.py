"""tf2's exceptions, for those of the graph."""

from __future__ import annotations

from gazelle.graph import tf as graph_tf

__all__ = [
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "NotImplementedException",
    "TimeoutException",
    "TransformException",
    "TypeException",
    "as_tf2_error",
]


class TransformException(Exception):  # noqa: N818 - tf2's name
    """Base of tf2's exceptions."""


class ConnectivityException(TransformException):
    """There is no way from one frame to the other."""


class LookupException(TransformException):
    """A frame does not exist."""


class ExtrapolationException(TransformException):
    """The time is outside what is known."""


class InvalidArgumentException(TransformException):
    """A frame name is not legal."""


class TimeoutException(TransformException):
    """The transform did not come in time."""


class NotImplementedException(Exception):  # noqa: N818 - tf2_ros's name
    """A buffer lacks a method."""


class TypeException(Exception):  # noqa: N818 - tf2_ros's name
    """No function is registered that transforms objects of this class."""


_ERRORS: dict[type[Exception], type[TransformException]] = {
    graph_tf.UnknownFrameError: LookupException,
    graph_tf.ConnectivityError: ConnectivityException,
    graph_tf.ExtrapolationError: ExtrapolationException,
    graph_tf.InvalidFrameError: InvalidArgumentException,
}


def as_tf2_error(error: graph_tf.TransformError) -> TransformException:
    """Return tf2's exception for one of the graph's."""
    return _ERRORS.get(type(error), TransformException)(str(error))
