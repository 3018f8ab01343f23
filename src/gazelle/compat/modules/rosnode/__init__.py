"""rosnode, on Gazelle's graph."""

from gazelle.compat.command_modules.rosnode import *  # noqa: F403
