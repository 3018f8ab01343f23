"""tf2_ros for rospy and rclpy programs: Buffer, listeners, broadcasters and tf2's exceptions."""

from __future__ import annotations

from gazelle.compat.tf.buffer import Buffer
from gazelle.compat.tf.buffer_interface import (
    BufferInterface,
    ConvertRegistration,
    TransformRegistration,
    convert,
)
from gazelle.compat.tf.conversions import nanoseconds, stamped
from gazelle.compat.tf.endpoints import (
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformListener,
)
from gazelle.compat.tf.exceptions import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    NotImplementedException,
    TimeoutException,
    TransformException,
    TypeException,
    as_tf2_error,
)

__all__ = [
    "DEFAULT_STATIC_TF_TOPIC",
    "DEFAULT_TF_TOPIC",
    "Buffer",
    "BufferInterface",
    "ConnectivityException",
    "ConvertRegistration",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "NotImplementedException",
    "StaticTransformBroadcaster",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "TransformRegistration",
    "TypeException",
    "as_tf2_error",
    "convert",
    "nanoseconds",
    "stamped",
]

DEFAULT_TF_TOPIC = "/tf"
DEFAULT_STATIC_TF_TOPIC = "/tf_static"
