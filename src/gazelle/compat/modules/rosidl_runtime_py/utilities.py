"""rosidl_runtime_py.utilities."""

from gazelle.compat.rosidl_runtime_py import *  # noqa: F403
