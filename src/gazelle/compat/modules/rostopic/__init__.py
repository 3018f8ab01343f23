"""rostopic, on Gazelle's graph."""

from gazelle.compat.command_modules.rostopic import *  # noqa: F403

NAME = "rostopic"
SUBSCRIBER_TIMEOUT = 5.0
