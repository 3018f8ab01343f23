"""rosidl_runtime_py.get_interfaces."""

from gazelle.compat.packages.runtime import *  # noqa: F403
