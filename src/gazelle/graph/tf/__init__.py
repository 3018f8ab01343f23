"""Coordinate frames over time: buffer, listener and broadcasters."""

from __future__ import annotations

from gazelle.graph.tf.broadcaster import (
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformListener,
)
from gazelle.graph.tf.buffer import FrameInfo, StampedPose, TransformBuffer
from gazelle.graph.tf.exceptions import (
    ConnectivityError,
    ExtrapolationError,
    InvalidFrameError,
    TransformError,
    UnknownFrameError,
)
from gazelle.graph.tf.message_filter import MessageFilter
from gazelle.graph.tf.view_frames import frames_as_dot, frames_as_string, frames_as_yaml

__all__ = [
    "ConnectivityError",
    "ExtrapolationError",
    "FrameInfo",
    "InvalidFrameError",
    "MessageFilter",
    "StampedPose",
    "StaticTransformBroadcaster",
    "TransformBroadcaster",
    "TransformBuffer",
    "TransformError",
    "TransformListener",
    "UnknownFrameError",
    "frames_as_dot",
    "frames_as_string",
    "frames_as_yaml",
]
