"""rospkg.rospack, by Gazelle."""

from gazelle.compat.rospkg import *  # noqa: F403
