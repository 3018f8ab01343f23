"""tf2_ros, on Gazelle's graph."""

from gazelle.compat.tf.buffer import *  # noqa: F403
from gazelle.compat.tf.buffer_interface import *  # noqa: F403
from gazelle.compat.tf.listener_and_broadcasters import *  # noqa: F403
from gazelle.compat.tf.exceptions import *  # noqa: F403

from . import transform_listener
