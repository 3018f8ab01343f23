"""Drop-in for nav2_common.launch."""

import sys as _sys

from gazelle.launch.ros2.nav2_common import (
    HasNodeParams,
    LaunchConfigAsBool,
    ParseMultiRobotPose,
    ReplaceString,
    RewrittenYaml,
)

__all__ = [
    "HasNodeParams",
    "LaunchConfigAsBool",
    "ParseMultiRobotPose",
    "ReplaceString",
    "RewrittenYaml",
]

# The original has a module per class; users import from those too.
for _name in ("has_node_params", "launch_config_as_bool", "parse_multirobot_pose", "replace_string", "rewritten_yaml"):
    _sys.modules[f"{__name__}.{_name}"] = _sys.modules[__name__]
