"""The PR2: a large description with loops in its Gazebo blocks, and a spawn (ROS 1 Melodic)."""

from __future__ import annotations

import math
from collections import Counter
from xml.etree import ElementTree

import pytest
from stage import Stage, robot_parts, roll_pitch_rad

XACRO = "xacro ws/src/pr2_description/robots/pr2.urdf.xacro --inorder KINECT1:=false KINECT2:=false"
# gazebo_ros_controller_manager and gazebo_ros_prosilica are Gazelle's ros_control and camera.
NO_TWIN = ("libgazebo_ros_power_monitor.so",)
SERVED = ("libgazebo_ros_controller_manager.so", "libgazebo_ros_prosilica.so")
RATES = {
    "/base_scan": 20.0, "/tilt_scan": 40.0, "/base_pose_ground_truth": 100.0,
    "/torso_lift_imu/data": 100.0,
}  # fmt: skip


def test_the_description_has_88_links_and_265_7_kg(stage: Stage) -> None:
    urdf = stage.run(XACRO).stdout
    parts = robot_parts(urdf)
    assert (len(parts.links), len(parts.joints)) == (88, 87)
    assert parts.kinds == {"fixed": 42, "continuous": 19, "revolute": 21, "prismatic": 5}
    assert parts.root == "base_footprint"
    assert parts.mass_kg == pytest.approx(265.7, abs=0.1)
    robot = ElementTree.fromstring(urdf)
    assert len(robot.findall("transmission")) == 30
    assert len(robot.findall("joint/mimic")) == 6
    assert len(list(robot.iter("plugin"))) == 26
    checked = stage.run("check_urdf /dev/stdin", stdin=urdf)
    assert checked.code == 0, checked.output
    assert "root Link: base_footprint has 1 child(ren)" in checked.stdout


def test_upload_takes_the_old_inorder(stage: Stage) -> None:
    uploaded = stage.run("roslaunch pr2_description upload_pr2.launch")
    assert uploaded.code == 0, uploaded.output
    text = stage.run("rosparam get /robot_description").stdout
    assert text.count("<link name") == 88 or text.count("link name=") >= 88


def test_the_robot_stands_and_its_sensors_run(stage: Stage) -> None:
    loops = Counter(
        str(joint.get("type"))
        for joint in ElementTree.fromstring(stage.run(XACRO).stdout).findall("gazebo/joint")
    )
    assert loops["screw"] == 5
    with stage.launch("roslaunch h04_spawn pr2_empty.launch") as sim:
        sim.wait_for_topics(*RATES)
        sim.run_sim(10.0, 400.0)
        for topic, hz in RATES.items():
            sim.has_rate(topic, hz, sim_s=2.0)
        pose = sim.topic("/base_pose_ground_truth").next().pose.pose
        assert abs(pose.position.z) < 0.05
        assert max(map(abs, roll_pitch_rad(pose.orientation))) < math.radians(5.0)
        for plugin in NO_TWIN:
            assert len(sim.said(f"warning: .*{plugin}")) == 1, plugin
        for plugin in SERVED:
            assert not sim.said(plugin), plugin
        services = stage.run("rosservice list").stdout.split()
        assert "/controller_manager/list_controllers" in services
        assert "/prosilica/image_raw" in sim.topics()
        # What it cannot hold of the loops it names.
        assert sim.said("torso_lift_screw_torso_lift_joint") or not sim.said("left out")
