"""tf2_ros.buffer_interface."""

from gazelle.compat.tf.buffer import *  # noqa: F403
from gazelle.compat.tf.buffer_interface import *  # noqa: F403
from gazelle.compat.tf.listener_and_broadcasters import *  # noqa: F403
from gazelle.compat.tf.exceptions import *  # noqa: F403
