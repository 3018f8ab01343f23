"""rosidl_runtime_py, on Gazelle's interfaces."""

from gazelle.compat.packages.runtime import *  # noqa: F403
