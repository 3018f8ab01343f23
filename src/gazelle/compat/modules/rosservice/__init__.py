"""rosservice, on Gazelle's graph."""

from gazelle.compat.command_modules.rosservice import *  # noqa: F403
