"""rosparam, on Gazelle's graph."""

from gazelle.compat.command_modules.rosparam import *  # noqa: F403
