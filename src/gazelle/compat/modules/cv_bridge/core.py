"""cv_bridge.core."""

from gazelle.compat.images.bridge import *  # noqa: F403
