"""rosnode, on Gazelle's graph."""

from gazelle.compat.commands.rosnode import *  # noqa: F403
