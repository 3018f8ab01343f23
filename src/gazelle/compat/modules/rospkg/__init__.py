"""rospkg: where packages are, answered by Gazelle's workspace."""

from gazelle.compat.rospkg import *  # noqa: F403
