"""Drop-in for ros_gz_bridge.actions."""

import sys as _sys

from gazelle.launch.ros2.ros_gz import RosGzBridge

__all__ = ["RosGzBridge"]

# The original has a module per class; users import from those too.
for _name in ("ros_gz_bridge",):
    _sys.modules[f"{__name__}.{_name}"] = _sys.modules[__name__]
