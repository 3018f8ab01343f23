"""tf.broadcaster."""

from gazelle.compat.tf.tf1 import TransformBroadcaster

__all__ = ["TransformBroadcaster"]
