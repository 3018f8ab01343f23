"""rosidl_runtime_py.set_message."""

from gazelle.compat.rosidl_runtime_py import *  # noqa: F403
