"""rosmsg, answered by Gazelle's interfaces."""

from gazelle.compat.commands.rosmsg import *  # noqa: F403
