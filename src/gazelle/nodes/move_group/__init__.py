"""move_group: MoveIt's node, over `gazelle.motion`.

It reads the parameters that MoveIt's own launch files give it (SRDF, ``kinematics.yaml``,
``joint_limits.yaml``, pipelines, controllers, ``trajectory_execution``) and offers MoveIt's topics,
services and actions under MoveIt's names, of ROS 1 or ROS 2 by who starts it.
"""

from __future__ import annotations

from gazelle.nodes.move_group.node import run

__all__ = ["run"]
