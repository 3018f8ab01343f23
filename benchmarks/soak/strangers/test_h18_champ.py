"""CHAMP's quadruped in its outdoor world: controllers under an empty name, nodes in C++ (ROS 1)."""

from __future__ import annotations

import pytest
from stage import Stage

# Some 22,000 pieces of trees and houses: loading takes half a minute, and again with the robot.
PATIENCE_S = 300.0
GAZEBO = "roslaunch champ_config gazebo.launch gui:=false"
LEGS = [f"{leg}_{part}_joint" for leg in ("lf", "rf", "lh", "rh")
        for part in ("hip", "upper_leg", "lower_leg")]  # fmt: skip
COMPILED = {
    "quadruped_controller_node": "champ_base",
    "state_estimation_node": "champ_base",
    "contact_sensor": "champ_gazebo",
}


def test_the_quadruped_has_twelve_legs_joints(stage: Stage) -> None:
    robot = stage.robot("ws/src/champ/champ_description/urdf/champ.urdf")
    assert len(robot.links) == 29
    assert robot.kinds["revolute"] == 12
    assert set(LEGS) <= set(robot.joints)
    assert robot.mass_kg == pytest.approx(4.47, abs=0.005)


def test_the_quadruped_stands_and_takes_a_trajectory(stage: Stage) -> None:
    with stage.launch(GAZEBO) as launch:
        for name, package in COMPILED.items():
            told = launch.says(rf"\[{name}\].*compiled code")
            assert f"[{package}]" in told
        told = launch.says("yocs_velocity_smoother")
        launch.wait_until(0.001, 300.0)
        launch.topic("/joint_group_position_controller/state").next(timeout_s=120.0)
        launch.run_sim(1.0, 600.0)
        pose = launch.true_pose("/")
        assert 0.05 <= pose.position.z <= 0.6
        launch.has_rate("/joint_states", 200.0)
        assert set(launch.joints()) == set(LEGS)
        launch.has_rate("/imu/data", 50.0)
        launch.has_rate("/odom/ground_truth", 10.0)
        launch.has_rate("/scan", 30.0)
        point = {
            "positions": [0.0, 0.4, -0.8] * 4,
            "time_from_start": {"sec": 1},
        }
        launch.publish("/joint_group_position_controller/command", joint_names=LEGS, points=[point])
        for name in LEGS:
            aim = {"hip": 0.0, "upper_leg": 0.4, "lower_leg": -0.8}[name[3:-6]]
            launch.joint_reaches(name, aim, 0.05)
        assert launch.true_pose("/").position.z >= 0.05
