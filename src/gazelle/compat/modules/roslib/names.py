"""roslib.names, by Gazelle."""

from gazelle.compat.resource_names import *  # noqa: F403
from gazelle.compat.rosgraph.names import *  # noqa: F403
