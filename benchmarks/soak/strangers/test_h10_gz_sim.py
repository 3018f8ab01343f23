"""The example worlds of gz-sim: its topics, its plugins and what they hold to (Harmonic)."""

from __future__ import annotations

import math

import pytest
from stage import Stage

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


def test_the_trajectory_controllers_of_three_models_are_there(stage: Stage) -> None:
    with stage.launch(f"gz sim -s -r {WORLDS}/joint_trajectory_controller.sdf") as sim:
        sim.wait_for_topics(
            "/model/RR_position_control/joint_trajectory",
            "/model/RR_velocity_control/joint_trajectory",
            "/custom_topic_effort_control",
        )
        models = stage.run("gz model --list").stdout
        for kind in ("position", "velocity", "effort"):
            assert f"RR_{kind}_control" in models, models


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
