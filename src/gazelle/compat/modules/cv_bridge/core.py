"""cv_bridge.core."""

from gazelle.compat.images.cv_bridge import *  # noqa: F403
