"""rosparam, on Gazelle's graph."""

from gazelle.compat.commands.rosparam import *  # noqa: F403
