"""The unmodified SLAMBOT, MIRA and my_robot against what Gazebo Classic does with them."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.shared_files import skip_module_without_shared

from gazelle.geometry import Pose
from gazelle.graph.gazebo_names import shown_transport_name
from gazelle.interfaces import service_type
from gazelle.interfaces.poses import twist_message
from gazelle.simulator import Simulation
from gazelle.simulator.gui import offer_views
from gazelle.workspace import Workspace

skip_module_without_shared()

Bring = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

pytestmark = pytest.mark.reference


def stamps_ms(messages: list[Any]) -> list[int]:
    return [m.header.stamp.sec * 1000 + m.header.stamp.nanosec // 10**6 for m in messages]


def drive(sim: Simulation, forward: float, turn: float) -> None:
    sim.publish("/cmd_vel", twist_message((forward, 0.0, 0.0), (0.0, 0.0, turn)))


@pytest.mark.tutorial
def test_its_topics_are_those_of_the_launch(slambot: Bring, oracles_dir: Path) -> None:
    sim = slambot()
    text = (oracles_dir / "gazebo_slambot" / "topics.txt").read_text()
    published = text.split("Subscribed topics")[0]
    elsewhere = {"/rosout", "/rosout_agg", "/tf_static"}
    wanted = dict(re.findall(r" \* (\S+) \[(\S+)\]", published))
    offered = {
        topic: kind.replace("/msg/", "/")
        for topic, kind in sim.server.node.topics.items()  # type: ignore[attr-defined]
        if not shown_transport_name(topic)
    }
    assert {k: v for k, v in wanted.items() if k not in elsewhere} == offered


@pytest.mark.tutorial
def test_rates_are_exact_in_simulated_time(slambot: Bring, listen: Listen) -> None:
    sim = slambot()
    scan, odom, tf = listen(sim, "/scan"), listen(sim, "/odom"), listen(sim, "/tf")
    joints, clock = listen(sim, "/joint_states"), listen(sim, "/clock")
    sim.run(seconds=2.0)
    assert stamps_ms(scan) == [182 * tick for tick in range(1, 11)]
    assert stamps_ms(odom) == stamps_ms(joints) == [10 * tick for tick in range(1, 201)]
    assert (len(tf), len(clock)) == (200, 2000)


@pytest.mark.tutorial
def test_the_scan_is_described_as_in_gazebo(slambot: Bring, listen: Listen) -> None:
    sim = slambot()
    scans = listen(sim, "/scan")
    sim.run(seconds=0.2)
    scan = scans[0]
    assert scan.header.frame_id == "laser_radar_link"
    assert (scan.angle_min, scan.angle_max) == pytest.approx((-3.0, 3.0))
    assert scan.angle_increment == pytest.approx(6 / 359)
    assert (scan.range_min, scan.range_max) == pytest.approx((0.1, 6.0))
    assert len(scan.ranges) == len(scan.intensities) == 360
    assert not np.any(scan.intensities)


def recorded_scans(oracles_dir: Path) -> list[tuple[Pose, np.ndarray[Any, Any]]]:
    """Poses and mean scans that Gazebo measured in the same world."""
    text = (oracles_dir / "gazebo_slambot" / "sensor_poses.txt").read_text()
    found = []
    for block in text.split("## pose ")[1:]:
        actual = re.search(r"actual x=(\S+) y=(\S+) z=(\S+) yaw=(\S+)", block)
        scan = re.search(r"scan mean of 8[^:]*: (\[.*?\])", block)
        assert actual is not None
        assert scan is not None
        x, y, _, yaw = (float(word) for word in actual.groups())
        values = json.loads(scan.group(1).replace("inf", "Infinity"))
        pose = Pose.from_xyz_rpy((x, y, 0.0), (0.0, 0.0, yaw))
        found.append((pose, np.array(values)))
    return found


def test_scans_agree_with_those_gazebo_measured(slambot: Bring, oracles_dir: Path) -> None:
    sim = slambot()
    for pose, measured in recorded_scans(oracles_dir):
        sim.model("slam_robot").pose = pose
        ours = np.mean([sim.sensor("rplidar").read().ranges_m[0] for _ in range(8)], axis=0)
        both = np.isfinite(ours) & np.isfinite(measured)
        assert np.mean(np.isfinite(ours) == np.isfinite(measured)) > 0.97
        # Both are means of 8 scans with σ = 0.01.
        difference = np.abs(ours[both] - measured[both])
        assert np.median(difference) < 0.02
        assert np.mean(difference < 0.05) > 0.97


@pytest.mark.tutorial
def test_camera_messages_are_gazebos(slambot: Bring, listen: Listen) -> None:
    sim = slambot()
    rgb, depth = (
        listen(sim, "/depth_camera/rgb/image_raw"),
        listen(sim, "/depth_camera/depth/image_raw"),
    )
    cloud = listen(sim, "/depth_camera/depth/points")
    infos = [listen(sim, f"/depth_camera/{kind}/camera_info") for kind in ("rgb", "depth")]
    sim.run(seconds=0.1)
    assert stamps_ms(rgb) == stamps_ms(depth) == stamps_ms(cloud) == [50, 100]
    for messages in (rgb, depth, cloud, *infos):
        assert messages[0].header.frame_id == "depth_camera_link"
    assert (rgb[0].encoding, rgb[0].step, rgb[0].width, rgb[0].height) == ("rgb8", 1920, 640, 480)
    assert (depth[0].encoding, depth[0].step) == ("32FC1", 2560)
    assert (cloud[0].point_step, cloud[0].row_step) == (32, 20480)
    focal = 552.4670324537112
    for info, *_ in infos:
        assert np.asarray(info.d).tolist() == [0.0] * 5
        assert info.k == pytest.approx([focal, 0, 320.5, 0, focal, 240.5, 0, 0, 1])
        assert info.p == pytest.approx([focal, 0, 320.5, 0, 0, focal, 240.5, 0, 0, 0, 1, 0])


def test_depth_agrees_with_the_picture_gazebo_took(slambot: Bring, oracles_dir: Path) -> None:
    sim = slambot()
    pose, _ = recorded_scans(oracles_dir)[1]
    sim.model("slam_robot").pose = pose
    depth = sim.sensor("depth_camera").read().depth_m
    block = (oracles_dir / "gazebo_slambot" / "sensor_poses.txt").read_text().split("## pose ")[2]
    grid = block.split("cols u=8,24..632 (step 16):\n")[1].splitlines()[:15]
    measured = np.array([[float(word) for word in line.split()] for line in grid])
    ours = depth[8::32, 8::16]
    ours = np.where((ours > 0.4) & (ours < 5.0), ours, np.nan)
    assert ours.shape == measured.shape
    both = np.isfinite(ours) & np.isfinite(measured)
    assert np.mean(np.isfinite(ours) == np.isfinite(measured)) > 0.98
    assert np.median(np.abs(ours[both] - measured[both])) < 0.002


@pytest.mark.tutorial
def test_forward_speed_is_0_22_for_0_2(slambot: Bring) -> None:
    sim = slambot()
    drive(sim, 0.2, 0.0)
    sim.run(seconds=1.0)
    start = sim.model("slam_robot").pose.position_m
    sim.run(seconds=4.0)
    end = sim.model("slam_robot").pose.position_m
    assert math.dist(start, end) / 4 == pytest.approx(0.2200, rel=0.01)


@pytest.mark.tutorial
def test_a_positive_yaw_command_turns_left_at_gazebos_rate(slambot: Bring) -> None:
    sim = slambot()
    drive(sim, 0.0, 0.5)
    sim.run(seconds=1.0)
    start = sim.model("slam_robot").pose.rpy_rad[2]
    sim.run(seconds=4.0)
    rate = (sim.model("slam_robot").pose.rpy_rad[2] - start) / 4
    assert 0.294 < rate < 0.307


@pytest.mark.tutorial
def test_idle_it_stays_where_it_is(slambot: Bring) -> None:
    sim = slambot()
    sim.run(seconds=1.0)
    before = sim.model("slam_robot").pose
    sim.run(seconds=10.0)
    after = sim.model("slam_robot").pose
    assert math.dist(before.position_m, after.position_m) < 1e-3
    assert abs(math.degrees(after.rpy_rad[2] - before.rpy_rad[2])) < 0.1


def test_it_outlives_half_a_newton_metre_on_each_joint_without_end(slambot: Bring) -> None:
    sim = slambot()
    offer_views(sim.server)
    engine, kind = sim.server.engine, service_type("gazelle_msgs/Do")
    joints = [name for name in engine.joint_names if engine.joint(name).is_driveable]
    names = [name.split("::", 1) for name in joints if name.startswith("slam_robot::")]
    assert names
    start = sim.model("slam_robot").pose.position_m
    for model, joint in names:
        request = {"op": "joint", "model": model, "joint": joint, "force": 0.5}
        text = json.dumps(request)
        call = sim.server.node.call  # type: ignore[attr-defined]
        assert json.loads(call("/_gazelle/do", kind.Request(request=text)).response) == {
            "value": {}
        }
    sim.run(seconds=3.0)
    end = sim.model("slam_robot").pose.position_m
    assert math.dist(start, end) < 0.5
    for model, joint in names:
        assert math.isfinite(engine.joint(f"{model}::{joint}").position)


@pytest.mark.tutorial
def test_odometry_and_transforms_are_the_plug_ins(slambot: Bring, listen: Listen) -> None:
    sim = slambot()
    odom, tf, joints = listen(sim, "/odom"), listen(sim, "/tf"), listen(sim, "/joint_states")
    drive(sim, 0.3, 0.3)
    sim.run(seconds=2.0)
    pose, message = sim.model("slam_robot").pose, odom[-1]
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_footprint")
    assert message.pose.pose.position.x == pytest.approx(pose.position_m[0], abs=1e-12)
    assert message.twist.twist.linear.x == pytest.approx(0.3295, rel=0.01)
    assert 0.15 < message.twist.twist.angular.z < 0.19
    edges = [(item.header.frame_id, item.child_frame_id) for item in tf[-1].transforms]
    assert edges == [
        ("odom", "base_footprint"),
        ("base_footprint", "right_wheel_link"),
        ("base_footprint", "left_wheel_link"),
    ]
    assert sorted(joints[-1].name) == ["left_wheel_joint", "right_wheel_joint"]
    assert len(joints[-1].velocity) == len(joints[-1].effort) == 0


def test_its_wheel_parameters_are_reported(slambot: Bring) -> None:
    sim = slambot()
    (found,) = sim.diagnostics.by_code("plugin.wheel-geometry")
    assert "wheel separation is 0.2 m, the joints are 0.324 m apart" in found.message
    assert "wheel diameter is 0.1 m, the wheels' shapes measure 0.11 m" in found.message
    assert sim.diagnostics.by_code("plugin.legacy-mode")
    assert not sim.diagnostics.by_code("plugin.wheels-swapped")
    unknown = sim.diagnostics.by_code("parameter.unknown")
    assert {re.search(r"<(\w+)>", item.message).group(1) for item in unknown} == {  # type: ignore[union-attr]
        "distortion_k1", "distortion_k2", "distortion_k3", "distortion_t1", "distortion_t2",
    }  # fmt: skip


def test_two_runs_of_it_are_equal(slambot: Bring, listen: Listen) -> None:
    def run() -> tuple[str, list[str]]:
        sim = slambot()
        seen = [listen(sim, topic) for topic in ("/scan", "/odom", "/tf", "/joint_states")]
        drive(sim, 0.2, 0.3)
        sim.run(seconds=0.6)
        return sim.state_hash(), [repr(message) for messages in seen for message in messages]

    first = run()
    assert len(first[1]) == 183
    assert run() == first
    assert run() == first


def test_nobody_listening_costs_no_ray(slambot: Bring) -> None:
    sim = slambot()
    sim.run(seconds=1.0)
    assert sim.server.sensors.computed == 0


@pytest.mark.tutorial
def test_mira_lands_upright_and_its_head_droops(
    load: Callable[..., Simulation], documents: Workspace
) -> None:
    path = documents.package("urdf_exam").path / "urdf" / "mira_gazebo.urdf"
    sim = load(path, workspace=documents, pose=Pose((0.0, 0.0, 0.2)))
    sim.run(seconds=0.3)
    assert sim.model("mira").pose.position_m[2] == pytest.approx(0.045, abs=1.5e-3)
    sim.run(seconds=1.2)
    roll, pitch, _ = sim.model("mira").pose.rpy_rad
    assert abs(roll) < 0.02
    assert abs(pitch) < 0.02
    sim.run(seconds=0.5)
    assert sim.joint("roll_joint").position == pytest.approx(-0.20, abs=0.01)
    assert sim.joint("pitch_joint").position == pytest.approx(0.44, abs=0.01)


@pytest.mark.tutorial
def test_my_robot_coasts_as_the_formula_says(
    load: Callable[..., Simulation], workspaces_dir: Path
) -> None:
    sim = load(workspaces_dir / "gazebo_models" / "stages" / "my_robot_7.sdf")
    sim.run(seconds=1.0)
    start = sim.model("my_robot").pose.position_m[0]
    assert abs(start) < 1e-3
    hinges = [sim.joint(f"{side}_wheel_hinge") for side in ("left", "right")]
    for hinge in hinges:
        hinge.command_effort(0.1)
    sim.run(seconds=2.0)
    acceleration = 2 * 0.1 / 0.1 / (3 + 2 * 1 / 0.1**2)
    speed = sim.link("chassis").linear_velocity_m_s[0]
    assert speed == pytest.approx(2 * acceleration, rel=0.03)
    travelled = sim.model("my_robot").pose.position_m[0] - start
    assert travelled == pytest.approx(acceleration * 2**2 / 2, rel=0.03)
    for hinge in hinges:
        hinge.command_effort(0.0)
    sim.run(seconds=2.0)
    assert sim.link("chassis").linear_velocity_m_s[0] == pytest.approx(speed, rel=0.03)
