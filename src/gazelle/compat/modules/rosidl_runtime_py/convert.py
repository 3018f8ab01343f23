"""rosidl_runtime_py.convert."""

from gazelle.compat.rosidl_runtime_py import *  # noqa: F403
