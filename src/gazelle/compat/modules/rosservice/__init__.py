"""rosservice, on Gazelle's graph."""

from gazelle.compat.commands.rosservice import *  # noqa: F403
