"""tf2_ros, on Gazelle's graph."""

from gazelle.compat.tf.tf2_ros import *  # noqa: F403

from .transform_listener import DEFAULT_STATIC_TF_TOPIC, DEFAULT_TF_TOPIC
