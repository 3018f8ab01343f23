"""rosidl_runtime_py.convert."""

from gazelle.compat.packages.runtime import *  # noqa: F403
