"""Drop-in for ros_gz_sim.actions."""

import sys as _sys

from gazelle.launch.ros2.ros_gz import GzServer, GzSpawnModel

__all__ = ["GzServer", "GzSpawnModel"]

# The original has a module per class; users import from those too.
for _name in ("gz_spawn_model", "gzserver"):
    _sys.modules[f"{__name__}.{_name}"] = _sys.modules[__name__]
