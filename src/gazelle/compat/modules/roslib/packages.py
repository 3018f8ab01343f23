"""roslib.packages."""

from gazelle.compat.roslib import *  # noqa: F403
