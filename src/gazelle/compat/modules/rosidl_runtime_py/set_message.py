"""rosidl_runtime_py.set_message."""

from gazelle.compat.packages.runtime import *  # noqa: F403
