"""Tests of this package, as a user writes them: ``pytest`` runs them where Gazelle is installed."""

from __future__ import annotations

from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1]


def test_the_launch_file_brings_the_robot_up_and_it_drives(gazelle_launch):
    launch = gazelle_launch("scout_robot", "scout.launch", args={"x": 0.5})
    launch.wait_for_line("Spawn status: SpawnModel: Successfully spawned entity")
    assert "<robot" in launch.param("/robot_description")
    assert "/gazebo" in launch.nodes()
    odometry = launch.topic("/odom")
    start = odometry.next()
    launch.publish("/cmd_vel", "geometry_msgs/Twist", linear={"x": 0.3})
    moved = odometry.wait_for(lambda m: m.pose.pose.position.x > start.pose.pose.position.x + 0.1)
    assert moved.header.frame_id == "odom"
    assert launch.stop() == 0


def test_its_lidar_sees_the_walls(gazelle_launch):
    launch = gazelle_launch("scout_robot", "scout.launch", lockstep=True, fast=True)
    scan = launch.topic("/scan").next()
    assert scan.header.frame_id == "lidar_link"
    assert scan.ranges[180] == pytest.approx(4.0, abs=0.05)
    launch.wait_until(sim_time_s=2.0)
    state = launch.call("/gazebo/get_model_state", model_name="scout")
    assert state.success
    assert abs(state.pose.position.x) < 1e-3


@pytest.mark.gazelle(seed=7)
def test_two_runs_of_one_seed_are_the_same(gazelle_simulation):
    hashes = []
    for _ in range(2):
        sim = gazelle_simulation(PACKAGE / "urdf" / "scout.urdf.xacro")
        sim.run(seconds=1.0)
        hashes.append(sim.state_hash())
    assert hashes[0] == hashes[1]
