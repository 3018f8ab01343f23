"""rosmsg, answered by Gazelle's interfaces."""

from gazelle.compat.command_modules.rosmsg import *  # noqa: F403
