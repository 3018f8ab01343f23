"""rostopic, on Gazelle's graph."""

from gazelle.compat.commands.rostopic import *  # noqa: F403
