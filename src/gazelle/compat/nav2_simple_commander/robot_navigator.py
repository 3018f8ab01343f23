"""``BasicNavigator``: Nav2's actions and services as methods (nav2_simple_commander)."""

from __future__ import annotations

import enum
import time
from typing import Any

from gazelle.compat import rclpy
from gazelle.compat.rclpy.action import ActionClient
from gazelle.compat.rclpy.node import Node
from gazelle.compat.rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from gazelle.interfaces import action_type, message_type, service_type

__all__ = ["BasicNavigator", "TaskResult"]


class TaskResult(enum.Enum):
    """How a task ended."""

    UNKNOWN = 0
    SUCCEEDED = 1
    CANCELED = 2
    FAILED = 3


_SLICE_S = 0.1
_SERVICE_S = 1.0
_SUCCEEDED = 4
_RESULTS = {_SUCCEEDED: TaskResult.SUCCEEDED, 5: TaskResult.CANCELED, 6: TaskResult.FAILED}


class BasicNavigator(Node):
    """A node that drives a robot through Nav2; one task at a time.

    Attributes:
        goal_handle: of the task.
        result_future: its end.
        feedback: the last one.
        status: number of ``action_msgs/GoalStatus`` at the end, None before.
        initial_pose: where localisation was told that the robot is, ``geometry_msgs/PoseStamped``.
        initial_pose_received: localisation has told a pose.
    """

    def __init__(self, node_name: str = "basic_navigator", namespace: str = "") -> None:
        """Make the node; the servers may come later."""
        super().__init__(node_name, namespace=namespace)
        self.goal_handle: Any = None
        self.result_future: Any = None
        self.feedback: Any = None
        self.status: int | None = None
        self.initial_pose_received = False
        self._action_clients: dict[str, Any] = {}
        self._service_clients: dict[str, Any] = {}
        latched = QoSProfile(
            durability=DurabilityPolicy.TRANSIENT_LOCAL,
            reliability=ReliabilityPolicy.RELIABLE,
            history=HistoryPolicy.KEEP_LAST,
            depth=1,
        )
        pose = message_type("geometry_msgs/msg/PoseWithCovarianceStamped")
        self.create_subscription(pose, "amcl_pose", self._on_pose, latched)
        self.initial_pose_pub = self.create_publisher(pose, "initialpose", 10)
        self.initial_pose: Any = message_type("geometry_msgs/msg/PoseStamped")()

    def setInitialPose(self, initial_pose: Any) -> None:
        """Tell localisation where the robot is."""
        self.initial_pose_received = False
        self.initial_pose = initial_pose
        self._send_initial_pose()

    def goToPose(self, pose: Any, behavior_tree: str = "") -> Any:
        """Begin to drive to a pose; false when it was not taken."""
        self.info(f"Navigating to goal: {pose.pose.position.x} {pose.pose.position.y}...")
        return self.begin("navigate_to_pose", "NavigateToPose", pose=pose,
                          behavior_tree=behavior_tree)  # fmt: skip

    def goThroughPoses(self, poses: Any, behavior_tree: str = "") -> Any:
        """Begin to drive through poses."""
        self.info(f"Navigating with {len(poses)} goals....")
        return self.begin("navigate_through_poses", "NavigateThroughPoses", poses=poses,
                          behavior_tree=behavior_tree)  # fmt: skip

    def followWaypoints(self, poses: Any) -> Any:
        """Begin to drive to one pose after another."""
        self.info(f"Following {len(poses)} goals....")
        return self.begin("follow_waypoints", "FollowWaypoints", poses=poses)

    def followPath(self, path: Any, controller_id: str = "", goal_checker_id: str = "") -> Any:
        """Begin to drive along a path."""
        self.info("Executing path...")
        return self.begin("follow_path", "FollowPath", path=path, controller_id=controller_id,
                          goal_checker_id=goal_checker_id)  # fmt: skip

    def spin(self, spin_dist: float = 1.57, time_allowance: int = 10) -> Any:
        """Begin to turn by an angle, rad."""
        self.info(f"Spinning to angle {spin_dist}....")
        return self.begin("spin", "Spin", target_yaw=float(spin_dist),
                          time_allowance=_seconds(time_allowance))  # fmt: skip

    def backup(
        self, backup_dist: float = 0.15, backup_speed: float = 0.025, time_allowance: int = 10
    ) -> Any:
        """Begin to back up, m and m/s."""
        self.info(f"Backing up {backup_dist} m at {backup_speed} m/s....")
        target = message_type("geometry_msgs/msg/Point")(x=float(backup_dist))
        return self.begin("backup", "BackUp", target=target, speed=float(backup_speed),
                          time_allowance=_seconds(time_allowance))  # fmt: skip

    def driveOnHeading(
        self, dist: float = 0.15, speed: float = 0.025, time_allowance: int = 10
    ) -> Any:
        """Begin to drive straight on, m and m/s."""
        self.info(f"Drive {dist} m on heading at {speed} m/s....")
        target = message_type("geometry_msgs/msg/Point")(x=float(dist))
        return self.begin("drive_on_heading", "DriveOnHeading", target=target, speed=float(speed),
                          time_allowance=_seconds(time_allowance))  # fmt: skip

    def getResult(self) -> TaskResult:
        """Return how the last task ended; UNKNOWN while it runs."""
        return _RESULTS.get(self.status or 0, TaskResult.UNKNOWN)

    def waitUntilNav2Active(self, navigator: str = "bt_navigator", localizer: str = "amcl") -> None:
        """Wait until localisation and navigation are active and know where the robot is."""
        if localizer != "robot_localization":
            self._wait_for_node_to_activate(localizer)
        if localizer == "amcl":
            self._wait_for_initial_pose()
        self._wait_for_node_to_activate(navigator)
        self.info("Nav2 is ready for use!")

    def getPath(self, start: Any, goal: Any, planner_id: str = "", use_start: bool = False) -> Any:
        """Return a path to a pose, None when there is none."""
        found = self.ask_action("compute_path_to_pose", "ComputePathToPose", start=start,
                                goal=goal, planner_id=planner_id, use_start=use_start)  # fmt: skip
        return None if found is None else found.path

    def getPathThroughPoses(
        self, start: Any, goals: Any, planner_id: str = "", use_start: bool = False
    ) -> Any:
        """Return a path through poses, None when there is none."""
        found = self.ask_action("compute_path_through_poses", "ComputePathThroughPoses",
                                start=start, goals=goals, planner_id=planner_id,
                                use_start=use_start)  # fmt: skip
        return None if found is None else found.path

    def changeMap(self, map_filepath: str) -> bool:
        """Let the map server load another map."""
        answer = self.ask("/map_server/load_map", "nav2_msgs/srv/LoadMap", map_url=map_filepath)
        if answer is None or answer.result != 0:
            self.error("Change map request failed!")
            return False
        self.info("Change map request was successful!")
        return True

    def clearAllCostmaps(self) -> None:
        """Let both costmaps forget what sensors saw."""
        self.clearLocalCostmap()
        self.clearGlobalCostmap()

    def clearLocalCostmap(self) -> None:
        """Let the local costmap forget what sensors saw."""
        kind = "nav2_msgs/srv/ClearEntireCostmap"
        self.ask("/local_costmap/clear_entirely_local_costmap", kind)

    def clearGlobalCostmap(self) -> None:
        """Let the global costmap forget what sensors saw."""
        kind = "nav2_msgs/srv/ClearEntireCostmap"
        self.ask("/global_costmap/clear_entirely_global_costmap", kind)

    def getGlobalCostmap(self) -> Any:
        """Return the global costmap, ``nav2_msgs/Costmap``."""
        answer = self.ask("/global_costmap/get_costmap", "nav2_msgs/srv/GetCostmap")
        return None if answer is None else answer.map

    def getLocalCostmap(self) -> Any:
        """Return the local costmap, ``nav2_msgs/Costmap``."""
        answer = self.ask("/local_costmap/get_costmap", "nav2_msgs/srv/GetCostmap")
        return None if answer is None else answer.map

    def lifecycleStartup(self) -> None:
        """Let every lifecycle manager bring its nodes up."""
        self._manage(0)

    def lifecycleShutdown(self) -> None:
        """Let every lifecycle manager take its nodes down."""
        self._manage(4)

    def begin(self, name: str, kind: str, **fields: Any) -> Any:
        """Send a goal and wait until it is taken; false when it is not."""
        client = self._action(name, kind)
        while not client.wait_for_server(timeout_sec=1.0):
            self.info(f"'{name}' action server not available, waiting...")
        goal = _filled(action_type(f"nav2_msgs/action/{kind}").Goal(), fields)
        self.feedback = self.status = None
        future = client.send_goal_async(goal, self._on_feedback)
        rclpy.spin_until_future_complete(self, future)
        self.goal_handle = future.result()
        if self.goal_handle is None or not self.goal_handle.accepted:
            self.error(f"Goal of {name} was rejected!")
            self.goal_handle = self.result_future = None
            return False
        self.result_future = self.goal_handle.get_result_async()
        return True

    def cancelTask(self) -> None:
        """Ask for the end of the task."""
        self.info("Canceling current task.")
        if self.result_future is not None and self.goal_handle is not None:
            future = self.goal_handle.cancel_goal_async()
            rclpy.spin_until_future_complete(self, future)

    def isTaskComplete(self) -> bool:
        """Tell whether the task is over; waits for a tenth of a second."""
        if self.result_future is None:
            return True
        rclpy.spin_until_future_complete(self, self.result_future, timeout_sec=_SLICE_S)
        found = self.result_future.result() if self.result_future.done() else None
        if found is None:
            return False
        self.status = int(found.status)
        if self.status != _SUCCEEDED:
            self.debug(f"Task with failed status code: {self.status}")
        return True

    def getFeedback(self) -> Any:
        """Return the last feedback of the task, None before the first."""
        return self.feedback

    def ask_action(self, name: str, kind: str, **fields: Any) -> Any:
        """Send a goal and return its result, None when it failed."""
        if not self.begin(name, kind, **fields):
            return None
        while not self.isTaskComplete():
            pass
        found = self.result_future.result()
        if self.status != _SUCCEEDED:
            why = getattr(found.result, "error_msg", "")
            self.warn(f"{name} failed with status code: {self.status}{f': {why}' if why else ''}")
            return None
        return found.result

    def ask(self, name: str, kind: str, **fields: Any) -> Any:
        """Call a service and return its response."""
        service = service_type(kind)
        if name not in self._service_clients:
            self._service_clients[name] = self.create_client(service, name)
        client = self._service_clients[name]
        while not client.wait_for_service(timeout_sec=_SERVICE_S):
            self.info(f"{name} service not available, waiting...")
        future = client.call_async(_filled(service.Request(), fields))
        rclpy.spin_until_future_complete(self, future)
        return future.result()

    def spin_once(self, timeout_s: float) -> None:
        """Let callbacks run."""
        rclpy.spin_once(self, timeout_sec=timeout_s)

    def destroyNode(self) -> None:
        """Take the node off the graph."""
        self.destroy_node()

    def destroy_node(self) -> None:
        """Take the node off the graph."""
        for client in self._action_clients.values():
            client.destroy()
        super().destroy_node()

    def info(self, msg: str) -> None:
        """Log."""
        self.get_logger().info(msg)

    def warn(self, msg: str) -> None:
        """Log."""
        self.get_logger().warning(msg)

    def error(self, msg: str) -> None:
        """Log."""
        self.get_logger().error(msg)

    def debug(self, msg: str) -> None:
        """Log."""
        self.get_logger().debug(msg)

    def _manage(self, command: int) -> None:
        kind = "nav2_msgs/srv/ManageLifecycleNodes"
        for name, types in self.get_service_names_and_types():
            if kind in types:
                self.ask(name, kind, command=command)

    def _wait_for_node_to_activate(self, node_name: str) -> None:
        self.debug(f"Waiting for {node_name} to become active..")
        service = f"{node_name}/get_state"
        while True:
            answer = self.ask(service, "lifecycle_msgs/srv/GetState")
            if answer is not None and answer.current_state.label == "active":
                return
            time.sleep(0.1)

    def _wait_for_initial_pose(self) -> None:
        while not self.initial_pose_received:
            self.info("Setting initial pose")
            self._send_initial_pose()
            self.spin_once(1.0)

    def _send_initial_pose(self) -> None:
        message = message_type("geometry_msgs/msg/PoseWithCovarianceStamped")()
        message.pose.pose = self.initial_pose.pose
        message.header = self.initial_pose.header
        self.initial_pose_pub.publish(message)

    def _action(self, name: str, kind: str) -> Any:
        if name not in self._action_clients:
            made = action_type(f"nav2_msgs/action/{kind}")
            self._action_clients[name] = ActionClient(self, made, name)
        return self._action_clients[name]

    def _on_feedback(self, message: Any) -> None:
        self.feedback = message.feedback

    def _on_pose(self, _message: Any) -> None:
        self.debug("Received amcl pose")
        self.initial_pose_received = True


def _filled(message: Any, fields: dict[str, Any]) -> Any:
    for name, value in fields.items():
        if hasattr(message, name):
            held = getattr(message, name)
            if hasattr(held, "goals") and not hasattr(value, "goals"):
                held.goals = list(value)
            else:
                setattr(message, name, value)
    return message


def _seconds(value: float) -> Any:
    return message_type("builtin_interfaces/msg/Duration")(sec=int(value))
