"""rosidl_runtime_py.utilities."""

from gazelle.compat.packages.runtime import *  # noqa: F403
