"""rosidl_runtime_py.get_interfaces."""

from gazelle.compat.rosidl_runtime_py import *  # noqa: F403
