"""The thirteen demos of gazebo_ros2_control (Humble, Gazebo Classic)."""

from __future__ import annotations

import math

import pytest
from stage import Seen, Stage, yaw_rad

PACKAGE = "gazebo_ros2_control_demos"


def launch(name: str) -> str:
    return f"ros2 launch {PACKAGE} {name}.launch.py"


def ready(seen: Seen, *controllers: str) -> None:
    seen.wait_for_controllers("joint_state_broadcaster", *controllers)


def odometry(seen: Seen, topic: str, after_s: float) -> tuple[float, float, float]:
    """Return x, y and heading on a topic of odometry a while from now."""
    seen.run_sim(after_s)
    pose = seen.topic(topic).next().pose.pose
    return pose.position.x, pose.position.y, yaw_rad(pose.orientation)


def test_the_cart_starts_at_its_initial_value_and_follows_the_goal(stage: Stage) -> None:
    with stage.launch(launch("cart_example_position")) as cart:
        cart.says("joint_state_broadcaster.* active")
        cart.says("joint_trajectory_controller.* active")
        ready(cart, "joint_trajectory_controller")
        assert cart.joints()["slider_to_cart"] == pytest.approx(1.0, abs=0.02)
        # The broadcaster's command has ended before that of the controller begins (OnProcessExit).
        said = cart.output
        first = said.index("loaded controller joint_state_broadcaster into state active")
        assert first < said.index("Loading controller 'joint_trajectory_controller'")
        followed = cart.topic("/joint_states")
        points = ", ".join(
            f"{{positions: [{at}], time_from_start: {{sec: {s}}}}}"
            for s, at in enumerate((0.0, -1.0, 1.0, 0.0))
        )
        goal = f"{{trajectory: {{joint_names: [slider_to_cart], points: [{points}]}}}}"
        sent = stage.run(
            "ros2 action send_goal /joint_trajectory_controller/follow_joint_trajectory "
            f'control_msgs/action/FollowJointTrajectory "{goal}"'
        )
        assert "SUCCEEDED" in sent.output, sent.output
        cart.wait_until(0.001)
        end_s, last = cart.sim_time_s, followed.next()
        positions = [last.position[0]]
        while last.header.stamp.sec < end_s - 1.0:
            last = followed.next()
            positions.append(last.position[0])
        assert min(positions) == pytest.approx(-1.0, abs=0.05)
        low = positions.index(min(positions))
        assert max(positions[low:]) == pytest.approx(1.0, abs=0.05)
        cart.joint_reaches("slider_to_cart", 0.0, 0.05)


def test_a_cart_goes_as_fast_as_it_is_told_and_has_an_imu(stage: Stage) -> None:
    with stage.launch(launch("cart_example_velocity")) as cart:
        ready(cart, "velocity_controller")
        # Loaded, without --set-state: it stays unconfigured.
        cart.wait_for_controllers("imu_sensor_broadcaster", state="unconfigured")
        cart.publish("/velocity_controller/commands", data=[1.0])
        cart.topic("/joint_states").wait_for(lambda m: abs(m.velocity[0] - 1.0) < 0.05)
        cart.publish("/velocity_controller/commands", data=[0.0])
        cart.topic("/joint_states").wait_for(lambda m: abs(m.velocity[0]) < 0.05)
        answer = stage.run("ros2 control set_controller_state imu_sensor_broadcaster inactive")
        assert answer.code == 0, answer.output
        answer = stage.run("ros2 control set_controller_state imu_sensor_broadcaster active")
        assert answer.code == 0, answer.output
        imu = cart.topic("/imu_sensor_broadcaster/imu").next()
        assert imu.header.frame_id == "imu"
        assert imu.linear_acceleration.z == pytest.approx(9.8, abs=0.2)


def test_an_effort_accelerates_the_cart(stage: Stage) -> None:
    with stage.launch(launch("cart_example_effort")) as cart:
        ready(cart, "effort_controller")
        at = cart.joints()["slider_to_cart"]
        assert at == pytest.approx(1.0, abs=0.05)
        states = cart.topic("/joint_states")
        cart.publish("/effort_controller/commands", data=[2.0])
        moved = states.wait_for(lambda m: m.velocity[0] > 1.0)
        later = states.wait_for(lambda m: m.velocity[0] > 3.0)
        took_s = (later.header.stamp.sec - moved.header.stamp.sec) + 1e-9 * (
            later.header.stamp.nanosec - moved.header.stamp.nanosec
        )
        # 2 N on 1 kg.
        speed_up = (later.velocity[0] - moved.velocity[0]) / took_s
        assert speed_up == pytest.approx(2.0, abs=0.1)
        cart.publish("/effort_controller/commands", data=[0.0])


def test_the_pendulum_swings_below_a_cart_that_is_moved(stage: Stage) -> None:
    with stage.launch(launch("pendulum_example_position")) as cart:
        ready(cart, "joint_trajectory_controller")
        states = cart.joints()
        assert set(states) == {"slider_to_cart", "cart_to_pendulum"}
        assert states["slider_to_cart"] == pytest.approx(1.0, abs=0.05)
        goal = (
            "{trajectory: {joint_names: [slider_to_cart], points: "
            "[{positions: [0.0], time_from_start: {sec: 1}}]}}"
        )
        sent = stage.run(
            "ros2 action send_goal /joint_trajectory_controller/follow_joint_trajectory "
            f'control_msgs/action/FollowJointTrajectory "{goal}"'
        )
        assert "SUCCEEDED" in sent.output, sent.output
        cart.joint_reaches("slider_to_cart", 0.0, 0.05)
        cart.topic("/joint_states").wait_for(
            lambda m: abs(dict(zip(m.name, m.velocity, strict=True))["cart_to_pendulum"]) > 0.05
        )


def test_the_pendulum_swings_below_a_cart_that_is_pushed(stage: Stage) -> None:
    with stage.launch(launch("pendulum_example_effort")) as cart:
        ready(cart, "effort_controller")
        assert cart.joints()["slider_to_cart"] == pytest.approx(1.0, abs=0.05)
        cart.publish("/effort_controller/commands", data=[20.0])
        cart.topic("/joint_states").wait_for(
            lambda m: dict(zip(m.name, m.velocity, strict=True))["slider_to_cart"] > 0.5
        )
        cart.publish("/effort_controller/commands", data=[0.0])


def test_the_left_finger_mimics_the_right_one(stage: Stage) -> None:
    with stage.launch(launch("gripper_mimic_joint_example")) as gripper:
        ready(gripper, "gripper_controller")
        first = gripper.joints()
        assert first["right_finger_joint"] == pytest.approx(0.15, abs=0.01)
        assert first["left_finger_joint"] == pytest.approx(0.15, abs=0.01)
        gripper.publish("/gripper_controller/commands", data=[0.3])
        gripper.joint_reaches("right_finger_joint", 0.3, 0.01)
        gripper.run_sim(1.0)
        assert gripper.joints() == pytest.approx(
            {"right_finger_joint": 0.3, "left_finger_joint": 0.3}, abs=0.01
        )


def test_the_diff_drive_goes_as_its_parameters_say(stage: Stage) -> None:
    with stage.launch(launch("diff_drive")) as robot:
        name = "diff_drive_base_controller"
        ready(robot, name)
        robot.has_rate(f"/{name}/odom", 50.0)
        read = stage.run(f"ros2 param get /{name} wheel_separation")
        assert "1.25" in read.output, read.output
        read = stage.run(f"ros2 param get /{name} wheel_radius")
        assert "0.3" in read.output, read.output
        robot.drive(f"/{name}/cmd_vel_unstamped", 0.2, 0.0, 3.0)
        states = robot.topic("/joint_states").next()
        for speed in states.velocity:
            # Wheels of 0.3 m at 0.2 m/s.
            assert speed == pytest.approx(0.2 / 0.3, abs=0.05)
        odom = robot.topic(f"/{name}/odom")
        robot.drive(f"/{name}/cmd_vel_unstamped", 3.0, 0.0, 3.0)
        speeds = [one.twist.twist.linear.x for one in odom.messages(100)]
        assert max(speeds) == pytest.approx(1.0, abs=0.05)
        at = robot.topic(f"/{name}/odom").next()
        assert at.header.frame_id == "odom"
        assert at.child_frame_id == "chassis"
        assert at.pose.pose.position.x > 2.0


def test_the_diff_drive_in_a_namespace_has_its_topics_there(stage: Stage) -> None:
    with stage.launch(launch("diff_drive_namespaced")) as robot:
        manager = "/r1/controller_manager"
        robot.wait_for_controllers(
            "joint_state_broadcaster", "diff_drive_base_controller", manager=manager
        )
        robot.has_rate("/r1/diff_drive_base_controller/odom", 50.0)
        # It takes stamps by default, without use_stamped_vel: false.
        topic = "/r1/diff_drive_base_controller/cmd_vel"
        robot.drive(topic, 0.5, 0.0, 3.0, stamped=True)
        assert robot.topic("/r1/diff_drive_base_controller/odom").next().pose.pose.position.x > 0.5
        assert "/diff_drive_base_controller/odom" not in robot.topics()


def test_the_tricycle_turns(stage: Stage) -> None:
    with stage.launch(launch("tricycle_drive")) as robot:
        ready(robot, "tricycle_controller")
        robot.has_rate("/tricycle_controller/odom", 50.0, share=0.2)
        # use_stamped_vel: false
        answer = stage.run("ros2 topic type /tricycle_controller/cmd_vel")
        assert answer.stdout.split() == ["geometry_msgs/msg/Twist"], answer.output
        robot.drive("/tricycle_controller/cmd_vel", 0.2, 0.1, 5.0)
        # The wheel stands at atan(wheelbase * turn / speed).
        robot.joint_reaches("steering_joint", math.atan(1.7 * 0.1 / 0.2), 0.1)
        x, _y, yaw = odometry(robot, "/tricycle_controller/odom", 0.1)
        assert x > 0.3
        assert yaw > 0.15


def test_a_vertical_cart_holds_against_gravity_with_position_pid(stage: Stage) -> None:
    with stage.launch(launch("vertical_cart_example_position_pid")) as cart:
        ready(cart, "position_controller")
        listed = stage.run("ros2 control list_hardware_interfaces")
        # The plug-in's 'position_pid' is its way to move the joint; what it offers is 'position'.
        assert "slider_to_cart/position [available] [claimed]" in listed.output, listed.output
        cart.publish("/position_controller/commands", data=[1.0])
        cart.run_sim(8.0)
        assert cart.joints()["slider_to_cart"] == pytest.approx(1.0, abs=0.15)
        cart.publish("/position_controller/commands", data=[-1.0])
        cart.run_sim(8.0)
        assert cart.joints()["slider_to_cart"] == pytest.approx(-1.0, abs=0.15)


def test_a_vertical_cart_holds_with_the_gains_of_the_yaml(stage: Stage) -> None:
    with stage.launch(launch("vertical_cart_example_position_pids_in_yaml")) as cart:
        ready(cart, "position_controller")
        cart.publish("/position_controller/commands", data=[1.0])
        cart.run_sim(8.0)
        assert cart.joints()["slider_to_cart"] == pytest.approx(1.0, abs=0.15)


def test_a_vertical_cart_keeps_its_speed_with_velocity_pid(stage: Stage) -> None:
    with stage.launch(launch("vertical_cart_example_velocity_pid")) as cart:
        ready(cart, "velocity_controller")
        cart.publish("/velocity_controller/commands", data=[0.3])
        cart.topic("/joint_states").wait_for(lambda m: m.velocity[0] > 0.25)
        cart.publish("/velocity_controller/commands", data=[0.0])
        cart.run_sim(3.0)
        first = cart.joints()["slider_to_cart"]
        cart.run_sim(2.0)
        assert cart.joints()["slider_to_cart"] == pytest.approx(first, abs=0.02)


def test_of_the_pair_one_is_there_since_both_have_the_same_name(stage: Stage) -> None:
    # Both are spawned as 'diffbot1', which the original's factory refuses as well.
    with stage.launch(launch("diff_drive_pair_namespaced")) as pair:
        pair.says(r"Entity \[diffbot1\] already exists")
        pair.says(r"Successfully spawned entity \[diffbot1\]")
        pair.says("Could not contact service /r[12]/controller_manager")
        services = {one.name for one in pair.graph.services()}
        there = [n for n in ("r1", "r2") if f"/{n}/controller_manager/list_controllers" in services]
        assert len(there) == 1
        pair.wait_for_controllers(
            "joint_state_broadcaster", "diff_drive_base_controller",
            manager=f"/{there[0]}/controller_manager",
        )  # fmt: skip
        pair.has_rate(f"/{there[0]}/diff_drive_base_controller/odom", 50.0)


@pytest.mark.parametrize(
    "example",
    ["position", "velocity", "effort", "gripper", "diff_drive", "tricycle_drive", "position_pid"],
)
def test_an_example_in_cpp_is_named_in_one_line(stage: Stage, example: str) -> None:
    done = stage.run(f"ros2 run {PACKAGE} example_{example}")
    assert done.code != 0
    told = [line for line in done.output.splitlines() if f"example_{example}" in line]
    assert len(told) == 1, done.output
    assert PACKAGE in told[0]
    assert "compiled code" in told[0]
