"""tf, on Gazelle's graph."""

from gazelle.compat.tf.tf1 import (
    ConnectivityException,
    Exception,
    ExtrapolationException,
    LookupException,
    TransformBroadcaster,
    Transformer,
    TransformerROS,
    TransformListener,
)

from . import listener, transformations

__all__ = [
    "ConnectivityException",
    "Exception",
    "ExtrapolationException",
    "LookupException",
    "TransformBroadcaster",
    "TransformListener",
    "Transformer",
    "TransformerROS",
    "listener",
    "transformations",
]
