"""What move_base's decisions come to: velocities, recoveries, rest."""

from __future__ import annotations

import math
import threading
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.graph import TimeJumpError
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_plane_pose
from gazelle.interfaces.stamps import set_header
from gazelle.nodes.move_base.local_planner import LocalPlanner
from gazelle.nodes.move_base.recovery_behaviors import Behaviour, RecoveryContext
from gazelle.nodes.move_base.state_machine import Plan, Trigger
from gazelle.nodes.navigation.costmap_2d_ros import Costmap2DRos
from gazelle.nodes.navigation.robot_pose import PlanePose
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer
from gazelle.nodes.twist_publisher import TwistPublisher

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Driver"]

_NANO = 1_000_000_000


class Driver:
    """Carries out what the executive decides; see `gazelle.nodes.move_base.state_machine.Drive`.

    Attributes:
        behaviours: for recovery.
        stopping: set when the node ends.
    """

    def __init__(
        self,
        node: Node,
        local_costmap: Costmap2DRos,
        global_costmap: Costmap2DRos,
        local: LocalPlanner,
        goals: SimpleActionServer,
    ) -> None:
        """Offer ``cmd_vel`` and ``recovery_status``."""
        self.behaviours: list[Behaviour] = []
        self.stopping = threading.Event()
        self._node = node
        self._local_costmap, self._global_costmap = local_costmap, global_costmap
        self._local = local
        self._goals = goals
        self._out = TwistPublisher(node, is_stamped=False)
        self._status: Any = message_type("move_base_msgs/msg/RecoveryStatus")
        self._status_out = node.create_publisher("~/recovery_status", self._status, queue_size=1)
        self._limited: tuple[PlanePose | None, float] | None = None

    @property
    def recovery_count(self) -> int:
        """How many recovery behaviours there are."""
        return len(self.behaviours)

    def recovery_context(self) -> RecoveryContext:
        """Return what recovery behaviours act on."""
        return RecoveryContext(
            self._global_costmap,
            self._local_costmap,
            self.drive,
            self.sleep,
            self._limit_speed,
            self._node.log,
        )

    def is_current(self) -> bool:
        """Tell whether the local costmap is up to date; why not is said."""
        stale = self._local_costmap.stale()
        for text in stale:
            self._local_costmap.frames.say(
                "warn", f"{self._local_costmap.name}: {text}", every_s=1.0
            )
        return not stale

    def set_plan(self, plan: Plan) -> bool:
        """Give a plan in the global costmap's frame to the local planner."""
        return self._local.set_plan(np.array(plan, float), self._global_costmap.global_frame)

    def is_goal_reached(self) -> bool:
        """Ask the local planner."""
        return self._local.goal_reached()

    def control(self) -> str:
        """Send the next velocity; return why there is none."""
        found = self._local.compute()
        if isinstance(found, str):
            self._local_costmap.frames.say("warn", found, key="no velocity", every_s=1.0)
            return found
        x, y, turn = found.velocity
        self._out.publish(x, y, turn)
        return ""

    def stop(self) -> None:
        """Send zero velocity."""
        self._out.stop()

    def drive(self, linear_m_s: float, angular_rad_s: float) -> None:
        """Send a velocity."""
        self._out.publish(linear_m_s, 0.0, angular_rad_s)

    def recover(self, index: int, trigger: Trigger) -> None:
        """Run a behaviour to its end and tell about it."""
        behaviour = self.behaviours[index]
        self._tell(index, behaviour)
        behaviour.run()
        self._node.log("debug", f"{trigger.name.lower()} recovery {behaviour.name} is over")

    def log(self, level: str, text: str) -> None:
        """Say something, the same thing at most once a second."""
        self._local_costmap.frames.say(level, text, every_s=1.0)

    def now_ns(self) -> int:
        """Tell the time."""
        return self._node.clock.now_ns()

    def rest(self, rests: bool) -> None:
        """Let costmaps rest, or wake them."""
        for costmap in (self._local_costmap, self._global_costmap):
            costmap.rests = rests

    def sleep(self, duration_s: float) -> bool:
        """Wait in the node's time; False when the goal is to be left."""
        self.sleep_until(self.now_ns() + int(duration_s * _NANO))
        return not (self.stopping.is_set() or self._goals.should_end)

    def sleep_until(self, target_ns: int) -> None:
        """Wait for a time; a jump back ends the wait."""
        try:
            self._node.clock.sleep_until(target_ns, self.stopping)
        except TimeJumpError:
            return

    def watch_distance(self, pose: PlanePose) -> None:
        """Lift a limit of speed when the robot has gone far enough."""
        if self._limited is None:
            return
        start, distance_m = self._limited
        if start is None:
            self._limited = (pose, distance_m)
        elif math.hypot(pose[0] - start[0], pose[1] - start[1]) >= distance_m:
            self._limited = None
            self._local.limit_speed(None)

    def _limit_speed(self, speed_m_s: float, distance_m: float) -> None:
        self._limited = (None, distance_m)
        self._local.limit_speed(speed_m_s)

    def _tell(self, index: int, behaviour: Behaviour) -> None:
        message = self._status(
            current_recovery_number=index,
            total_number_of_recoveries=len(self.behaviours),
            recovery_behavior_name=behaviour.name,
        )
        pose = self._global_costmap.pose()
        if pose is not None:
            set_header(message.pose_stamped, self.now_ns(), self._global_costmap.global_frame)
            set_plane_pose(message.pose_stamped.pose, pose)
        self._status_out.publish(message)
