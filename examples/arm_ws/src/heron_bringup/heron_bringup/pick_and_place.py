"""Carry the cube over the wall: plan, go down, grip, lift, carry, put down.

It talks to move_group and to the hand's controller with the messages that every ROS 2 program
uses, so it runs wherever both are up: ``ros2 run heron_bringup pick_and_place``.
"""

import sys

import rclpy
from control_msgs.action import GripperCommand
from geometry_msgs.msg import Pose
from moveit_msgs.action import ExecuteTrajectory, MoveGroup
from moveit_msgs.msg import (
    AttachedCollisionObject,
    CollisionObject,
    Constraints,
    JointConstraint,
    MoveItErrorCodes,
    OrientationConstraint,
    PlanningScene,
    PositionConstraint,
)
from moveit_msgs.srv import ApplyPlanningScene, GetCartesianPath
from rclpy.action import ActionClient
from rclpy.node import Node
from shape_msgs.msg import SolidPrimitive

FRAME = "world"
TOOL = "tool_link"
OPEN, CLOSED = 0.04, 0.0
PICK, PLACE = (0.36, 0.18), (0.36, -0.18)
ABOVE, AT_CUBE, AT_PLACE = 0.25, 0.13, 0.133
READY = [0.0, -0.3, 1.9, 0.0, 1.5416, 0.0]


class StepFailed(Exception):
    """A step could not be done."""


def pose_at(x, y, z, *, down=False):
    pose = Pose()
    pose.position.x, pose.position.y, pose.position.z = x, y, z
    if down:
        pose.orientation.y, pose.orientation.w = 1.0, 0.0
    else:
        pose.orientation.w = 1.0
    return pose


def box(name, size, at):
    item = CollisionObject(id=name, operation=CollisionObject.ADD)
    item.header.frame_id = FRAME
    item.primitives = [SolidPrimitive(type=SolidPrimitive.BOX, dimensions=list(size))]
    item.primitive_poses = [pose_at(*at)]
    return item


class PickAndPlace(Node):
    def __init__(self):
        super().__init__("pick_and_place")
        self.mover = ActionClient(self, MoveGroup, "/move_action")
        self.executor_of_paths = ActionClient(self, ExecuteTrajectory, "/execute_trajectory")
        self.hand = ActionClient(self, GripperCommand, "/hand_controller/gripper_cmd")
        self.scene = self.create_client(ApplyPlanningScene, "/apply_planning_scene")
        self.straight = self.create_client(GetCartesianPath, "/compute_cartesian_path")

    def run(self):
        for one in (self.mover, self.executor_of_paths, self.hand):
            one.wait_for_server()
        for one in (self.scene, self.straight):
            one.wait_for_service()
        self.tell_scene()
        self.grip(OPEN)
        self.go_above(*PICK)
        self.go_straight(*PICK, AT_CUBE)
        self.grip(CLOSED)
        self.attach()
        self.go_straight(*PICK, ABOVE)
        self.go_above(*PLACE)
        self.go_straight(*PLACE, AT_PLACE)
        self.grip(OPEN)
        self.detach()
        self.go_straight(*PLACE, ABOVE)
        self.go_ready()

    def tell_scene(self):
        # The bench is a little lower than it is, or the cube would stand in it.
        self.apply(objects=[
            box("bench", (0.3, 0.8, 0.1), (0.4, 0.0, 0.046)),
            box("wall", (0.3, 0.02, 0.2), (0.4, 0.0, 0.2)),
            box("cube", (0.04, 0.04, 0.04), (*PICK, 0.12)),
        ])  # fmt: skip

    def attach(self):
        item = AttachedCollisionObject(link_name=TOOL)
        item.object.id = "cube"
        item.object.operation = CollisionObject.ADD
        item.touch_links = ["hand_link", "left_finger_link", "right_finger_link"]
        self.apply(attached=[item])

    def detach(self):
        item = AttachedCollisionObject(link_name=TOOL)
        item.object.id = "cube"
        item.object.operation = CollisionObject.REMOVE
        self.apply(attached=[item])

    def apply(self, objects=(), attached=()):
        request = ApplyPlanningScene.Request(scene=PlanningScene(is_diff=True))
        request.scene.robot_state.is_diff = True
        request.scene.world.collision_objects = list(objects)
        request.scene.robot_state.attached_collision_objects = list(attached)
        if not self.wait(self.scene.call_async(request)).success:
            raise StepFailed("the planning scene was not taken")

    def go_above(self, x, y):
        place = PositionConstraint(link_name=TOOL, weight=1.0)
        place.header.frame_id = FRAME
        region = SolidPrimitive(type=SolidPrimitive.SPHERE, dimensions=[0.002])
        place.constraint_region.primitives = [region]
        place.constraint_region.primitive_poses = [pose_at(x, y, ABOVE)]
        turn = OrientationConstraint(link_name=TOOL, weight=1.0)
        turn.header.frame_id = FRAME
        turn.orientation = pose_at(x, y, ABOVE, down=True).orientation
        turn.absolute_x_axis_tolerance = 0.01
        turn.absolute_y_axis_tolerance = 0.01
        turn.absolute_z_axis_tolerance = 0.01
        goal = Constraints(position_constraints=[place], orientation_constraints=[turn])
        self.move(goal, f"above ({x}, {y})")

    def go_ready(self):
        rows = [
            JointConstraint(
                joint_name=f"joint_{number}", position=value, tolerance_above=1e-3,
                tolerance_below=1e-3, weight=1.0,
            )
            for number, value in enumerate(READY, 1)
        ]  # fmt: skip
        self.move(Constraints(joint_constraints=rows), "ready")

    def move(self, constraints, name):
        goal = MoveGroup.Goal()
        goal.request.group_name = "arm"
        goal.request.allowed_planning_time = 5.0
        goal.request.num_planning_attempts = 2
        goal.request.max_velocity_scaling_factor = 1.0
        goal.request.max_acceleration_scaling_factor = 1.0
        goal.request.goal_constraints = [constraints]
        self.get_logger().info(f"moving {name}")
        self.check(self.send(self.mover, goal).error_code, f"moving {name}")

    def go_straight(self, x, y, z):
        request = GetCartesianPath.Request(group_name="arm", link_name=TOOL, max_step=0.01)
        request.header.frame_id = FRAME
        request.waypoints = [pose_at(x, y, z, down=True)]
        request.avoid_collisions = True
        request.max_velocity_scaling_factor = 0.5
        request.max_acceleration_scaling_factor = 0.5
        answer = self.wait(self.straight.call_async(request))
        self.check(answer.error_code, "planning straight")
        if answer.fraction < 1.0:
            text = f"only {100 * answer.fraction:.0f} % of the way to z = {z}"
            raise StepFailed(f"{text}: {answer.error_code.message}")
        self.get_logger().info(f"moving straight to z = {z}")
        goal = ExecuteTrajectory.Goal(trajectory=answer.solution)
        self.check(self.send(self.executor_of_paths, goal).error_code, "moving straight")

    def grip(self, position):
        goal = GripperCommand.Goal()
        goal.command.position = position
        goal.command.max_effort = 10.0
        result = self.send(self.hand, goal)
        # Fingers that stall while they close have something between them.
        if position == CLOSED and not (result.stalled and not result.reached_goal):
            raise StepFailed(
                f"the gripper closed to {result.position:.3f} m with nothing in it: the cube is "
                f"not at x = {PICK[0]} m, y = {PICK[1]} m, where this program begins; put it "
                "back by 'gazelle ros2 service call /reset_world std_srvs/srv/Empty', then start "
                "it again"
            )
        if position != CLOSED and not result.reached_goal:
            raise StepFailed(f"the gripper stopped at {result.position:.3f} m")

    def check(self, code, what):
        if code.val != MoveItErrorCodes.SUCCESS:
            raise StepFailed(f"{what}: error {code.val}: {getattr(code, 'message', '')}")

    def send(self, client, goal):
        handle = self.wait(client.send_goal_async(goal))
        if not handle.accepted:
            raise StepFailed("a goal was rejected")
        return self.wait(handle.get_result_async()).result

    def wait(self, future):
        rclpy.spin_until_future_complete(self, future)
        return future.result()


def main():
    rclpy.init()
    node = PickAndPlace()
    try:
        node.run()
        node.get_logger().info("the cube is on the other side")
        return 0
    except StepFailed as error:
        node.get_logger().error(str(error))
        return 1
    finally:
        node.destroy_node()
        rclpy.shutdown()


if __name__ == "__main__":
    sys.exit(main())
