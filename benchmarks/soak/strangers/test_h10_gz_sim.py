"""The example worlds of gz-sim: its topics, its plugins and what they hold to (Harmonic)."""

from __future__ import annotations

import math
import re
import shlex

import pytest
from stage import Stage

from gazelle.engine import JointHandle
from gazelle.interfaces import message_type
from gazelle.simulator import Simulation

WORLDS = "gz-sim/examples/worlds"
ENVIRONMENT = {"GZ_VERSION": "harmonic"}


def test_vehicles_have_the_topics_and_keep_the_limits_of_gz_sim(stage: Stage) -> None:
    with stage.launch(f"gz sim -s -r {WORLDS}/diff_drive.sdf") as sim:
        wanted = {
            "/model/vehicle_blue/cmd_vel", "/model/vehicle_blue/odometry",
            "/model/vehicle_green/odometry", "/world/diff_drive/stats", "/clock",
        }  # fmt: skip
        sim.wait_for_topics(*wanted)
        assert wanted <= set(stage.run("gz topic -l").stdout.split())
        sim.has_rate("/model/vehicle_blue/odometry", 1.0)
        sim.has_rate("/model/vehicle_green/odometry", 50.0)
        statistics = sim.topic("/world/diff_drive/stats")
        first = statistics.next().iterations
        assert statistics.next().iterations > first
        assert "iterations:" in stage.run("gz topic -e -t /world/diff_drive/stats -n 1").stdout

        odometry = sim.topic("/model/vehicle_green/odometry")
        sent = stage.run(
            "gz topic -t /model/vehicle_green/cmd_vel -m gz.msgs.Twist -p 'linear:{x:1.0}'"
        )
        assert sent.code == 0, sent.output

        def seen(above: float) -> tuple[float, float]:
            one = odometry.wait_for(lambda message: message.twist.twist.linear.x > above)
            return one.header.stamp.sec + one.header.stamp.nanosec * 1e-9, one.twist.twist.linear.x

        begun_s, slow = seen(0.05)
        ended_s, fast = seen(0.40)
        assert (fast - slow) / (ended_s - begun_s) == pytest.approx(1.0, rel=0.1)
        seen(0.49)
        speeds = [one.twist.twist.linear.x for one in odometry.messages(50)]
        assert speeds == pytest.approx([0.5] * 50, abs=0.02)


def test_pendulums_of_sdf_1_11_follow_each_other(stage: Stage) -> None:
    world = stage.folder / WORLDS / "mimic_fast_slow_pendulums_world.sdf"
    with Simulation.load(world) as simulation:
        names = [
            "pendulum_with_base", "pendulum_with_base_mimic_slow_follows_fast",
            "pendulum_with_base_mimic_fast_follows_slow",
        ]  # fmt: skip
        apart = dict.fromkeys(names, 0.0)
        for _ in range(40):
            simulation.run(seconds=0.05)
            for name in names:
                slow = simulation.joint(f"{name}::slow_joint").position
                fast = simulation.joint(f"{name}::fast_joint").position
                assert math.isfinite(slow) and math.isfinite(fast)
                apart[name] = max(apart[name], abs(slow - fast))
        assert apart[names[0]] > 0.1
        assert apart[names[1]] < 0.01
        assert apart[names[2]] < 0.01


def test_three_models_follow_the_trajectories_that_their_world_shows(stage: Stage) -> None:
    world = stage.folder / WORLDS / "joint_trajectory_controller.sdf"
    shown = re.findall(r'gz topic -t "([^"]*)" -m (\S+) -p \'([^\']*)\'', world.read_text())
    topics = {
        "position": "/model/RR_position_control/joint_trajectory",
        "velocity": "/model/RR_velocity_control/joint_trajectory",
        "effort": "/custom_topic_effort_control",
    }
    with stage.launch(f"gz sim -s -r {WORLDS}/joint_trajectory_controller.sdf") as sim:
        sim.wait_for_topics(*topics.values(), *(f"{one}_progress" for one in topics.values()))
        models = stage.run("gz model --list").stdout
        for kind in topics:
            assert f"RR_{kind}_control" in models, models
        assert not sim.said("JointTrajectoryController.*compiled code")
        sent = dict(zip(topics, [one for one in shown if "$" not in one[2]], strict=True))
        for kind, (topic, gz_type, text) in sent.items():
            assert topic == topics[kind]
            progress = sim.topic(f"{topic}_progress")
            done = stage.run(f"gz topic -t {topic} -m {gz_type} -p {shlex.quote(text)}")
            assert done.code == 0, done.output
            count = text.count("points")
            heard = [one.data for one in progress.messages(count)]
            assert heard == pytest.approx([(n + 1) / count for n in range(count)])
        assert not sim.said("Traceback|nan")


def test_the_robots_move_as_their_points_say(stage: Stage) -> None:
    world = stage.folder / WORLDS / "joint_trajectory_controller.sdf"
    with Simulation.load(world) as simulation:

        def joints(kind: str) -> list[JointHandle]:
            return [
                simulation.joint(f"RR_{kind}_control::RR_{kind}_control_joint{n}") for n in (1, 2)
            ]

        def send(topic: str, kind: str, name: str, *rows: tuple[float, ...]) -> None:
            message = message_type("trajectory_msgs/JointTrajectory")()
            message.joint_names = [f"RR_{kind}_control_joint{n}" for n in (1, 2)]
            for after_s, *values in rows:
                point = message_type("trajectory_msgs/JointTrajectoryPoint")()
                setattr(point, name, values)
                whole_s = int(after_s)
                point.time_from_start.sec = whole_s
                point.time_from_start.nanosec = round((after_s - whole_s) * 1e9)
                message.points.append(point)
            simulation.publish(topic, message)

        simulation.run(seconds=3.0)
        begun = [one.position for one in joints("position")]
        assert begun == pytest.approx([0.7854, -1.5708], abs=0.05)
        still = [one.velocity for one in joints("velocity")]
        assert still == pytest.approx([0.0, 0.0], abs=0.05)
        where = "/model/RR_position_control/joint_trajectory"
        send(where, "position", "positions", (1.0, -0.7854, 1.5708), (2.0, 0.0, 0.0))
        simulation.run(seconds=0.99)
        there = [one.position for one in joints("position")]
        assert there == pytest.approx([-0.7854, 1.5708], abs=0.1)
        simulation.run(seconds=3.0)
        assert [one.position for one in joints("position")] == pytest.approx([0.0, 0.0], abs=0.05)

        where = "/model/RR_velocity_control/joint_trajectory"
        send(where, "velocity", "velocities", (0.05, 0.7854, -0.7854), (1.05, 3.1416, -3.1416))
        simulation.run(seconds=2.0)
        there = [one.velocity for one in joints("velocity")]
        assert there == pytest.approx([3.1416, -3.1416], abs=0.1)

        before = [one.position for one in joints("effort")]
        send("/custom_topic_effort_control", "effort", "effort", (1.0, 1.0, 0.5))
        simulation.run(seconds=1.0)
        after = [one.position for one in joints("effort")]
        assert all(abs(new - old) > 0.1 for old, new in zip(before, after, strict=True))


def test_sensors_have_their_rates(stage: Stage) -> None:
    with stage.launch(f"gz sim -s -r {WORLDS}/sensors.sdf") as sim:
        for topic, hz in {
            "/altimeter": 30.0, "/air_pressure": 30.0, "/imu": 100.0, "/magnetometer": 100.0,
        }.items():  # fmt: skip
            sim.wait_for_topics(topic)
            sim.has_rate(topic, hz)
        force = next(name for name in sorted(sim.topics()) if name.endswith("/forcetorque"))
        sim.has_rate(force, 10.0)


def test_a_lidar_works_and_a_line_says_what_stands_in_for_a_model_of_fuel(stage: Stage) -> None:
    with stage.launch(f"gz sim -s -r {WORLDS}/gpu_lidar_sensor.sdf") as sim:
        sim.wait_for_topics("/lidar")
        sim.has_rate("/lidar", 10.0)
        # Gazelle has plain shapes of this name, as its database of originals says.
        told = sim.said(r"load\.stand-in")
        assert len(told) == 1, told
        assert "stand in for Fuel's model 'Playground'" in told[0]
