"""rostopic, on Gazelle's graph."""

from gazelle.compat.commands.rostopic import *  # noqa: F403

NAME = "rostopic"
SUBSCRIBER_TIMEOUT = 5.0
