"""rosidl_runtime_py, on Gazelle's interfaces."""

from gazelle.compat.rosidl_runtime_py import *  # noqa: F403
