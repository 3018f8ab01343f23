"""Drop-in for nav2_common.launch."""

from gazelle.launch.ros2.nav2 import (
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
