"""tf2_ros.transform_listener."""

from gazelle.compat.tf.tf2_ros import *  # noqa: F403

DEFAULT_TF_TOPIC = "/tf"
DEFAULT_STATIC_TF_TOPIC = "/tf_static"
