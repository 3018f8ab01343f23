"""Ranges: the nearest beam, and the cone of a sonar."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.geometry import Pose
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

RAY = """<ray><scan><horizontal><samples>5</samples><min_angle>-0.2</min_angle>
  <max_angle>0.2</max_angle></horizontal><vertical><samples>3</samples><min_angle>-0.1</min_angle>
  <max_angle>0.1</max_angle></vertical></scan><range><min>0.05</min><max>4</max></range></ray>"""
SONAR = """<pose>0 0 0 0 -1.5707963 0</pose>
  <sonar><min>0.05</min><max>4</max><radius>0.5</radius></sonar>"""
# The near face of the wall is 0.1 m before its middle.
WORLD = """<sdf version="1.6"><world name="w">
  <model name="eye"><static>true</static><link name="l"><sensor name="s" type="{kind}">
    <update_rate>20</update_rate>{spec}
    <plugin name="p" filename="{filename}">{keys}</plugin></sensor></link></model>
  <model name="wall"><static>true</static><pose>{x} 0 0 0 0 0</pose><link name="l">
    <collision name="c"><geometry><box><size>0.2 8 8</size></box></geometry></collision>
  </link></model></world></sdf>"""


def world(filename: str, keys: str = "", kind: str = "ray", x: float = 2.1) -> str:
    spec = SONAR if kind == "sonar" else RAY
    return WORLD.format(kind=kind, spec=spec, filename=filename, keys=keys, x=x)


KEYS = "<topicName>ir</topicName><frameName>/eye</frameName><fov>0.3</fov>"


@pytest.mark.parametrize("kind", ["ray", "sonar"])
@pytest.mark.parametrize("filename", ["libgazebo_ros_range.so", "libhector_gazebo_ros_sonar.so"])
def test_the_range_is_that_of_the_nearest_beam(
    load: Load, listen: Listen, kind: str, filename: str
) -> None:
    keys = "<topicName>d</topicName><frameName>eye</frameName><updateRate>10</updateRate>"
    sim = load(world(filename, keys, kind))
    messages = listen(sim, "/d")
    sim.run(seconds=1.0)
    message = messages[-1]
    assert len(messages) == 10
    assert message.header.frame_id == "eye"
    assert message.range == pytest.approx(2.0, abs=1e-3)
    assert (message.min_range, message.max_range) == pytest.approx((0.05, 4.0))
    assert message.radiation_type == 0
    # Not straight ahead, and nearer than the wall.
    ball = """<sdf version="1.6"><model name="ball"><static>true</static><link name="l">
      <collision name="c"><geometry><sphere><radius>0.05</radius></sphere></geometry></collision>
      </link></model></sdf>"""
    sim.spawn(ball, pose=Pose((1.2 * math.cos(0.1), 1.2 * math.sin(0.1), 0.0)))
    sim.run(seconds=0.1)
    assert messages[-1].range == pytest.approx(1.15, abs=0.005)


def test_infrared_and_field_of_view_are_as_the_keys_say(load: Load, listen: Listen) -> None:
    keys = KEYS + "<radiation>infrared</radiation>"
    sim = load(world("libgazebo_ros_range.so", keys))
    messages = listen(sim, "/ir")
    sim.run(seconds=0.2)
    assert messages[-1].radiation_type == 1
    assert messages[-1].header.frame_id == "eye"
    assert messages[-1].field_of_view == pytest.approx(0.3)


def test_hectors_sonar_has_the_smaller_angle_as_field_of_view(load: Load, listen: Listen) -> None:
    sim = load(world("libhector_gazebo_ros_sonar.so"))
    messages = listen(sim, "/sonar")
    sim.run(seconds=0.2)
    assert messages[-1].field_of_view == pytest.approx(0.2)
    assert messages[-1].header.frame_id == "/sonar_link"


def test_no_echo_is_the_largest_range_without_noise(load: Load, listen: Listen) -> None:
    keys = KEYS + "<gaussianNoise>0.1</gaussianNoise>"
    sim = load(world("libgazebo_ros_range.so", keys, x=50.0))
    messages = listen(sim, "/ir")
    sim.run(seconds=1.0)
    assert {message.range for message in messages} == {4.0}


def test_noise_has_its_sigma_and_stays_in_range(load: Load, listen: Listen) -> None:
    keys = KEYS + "<gaussianNoise>0.05</gaussianNoise>"
    sim = load(world("libgazebo_ros_range.so", keys))
    messages = listen(sim, "/ir")
    sim.run(seconds=50.0)
    values = np.array([message.range for message in messages])
    assert len(values) == 1000
    assert values.std() == pytest.approx(0.05, rel=0.1)
    assert abs(values.mean() - 2.0) < 4 * 0.05 / math.sqrt(1000)
    near = load(world("libgazebo_ros_range.so", keys.replace("0.05", "0.5"), x=4.05))
    close = listen(near, "/ir")
    near.run(seconds=5.0)
    assert max(message.range for message in close) == 4.0


def test_a_sonar_is_read_on_demand(load: Load) -> None:
    sim = load(world("libgazebo_ros_range.so", KEYS, "sonar"))
    assert sim.sensor("s").read().range_m == pytest.approx(2.0, abs=1e-3)


def test_a_block_laser_is_a_cloud_with_every_ray(load: Load, listen: Listen) -> None:
    keys = "<topicName>cloud</topicName><frameName>eye</frameName>"
    sim = load(world("libgazebo_ros_block_laser.so", keys))
    clouds = listen(sim, "/cloud")
    sim.run(seconds=0.2)
    cloud = clouds[-1]
    assert len(clouds) == 4
    assert len(cloud.points) == len(cloud.channels[0].values) == 15
    assert [point.x for point in cloud.points] == pytest.approx([2.0] * 15, abs=2e-3)
    # Row by row from below, columns from the right.
    yaw, pitch = np.meshgrid(np.linspace(-0.2, 0.2, 5), np.linspace(-0.1, 0.1, 3))
    assert [p.y for p in cloud.points] == pytest.approx(2.0 * np.tan(yaw).ravel(), abs=2e-3)
    heights = 2.0 * (np.tan(pitch) / np.cos(yaw)).ravel()
    assert [p.z for p in cloud.points] == pytest.approx(heights, abs=2e-3)


def test_a_block_laser_that_sees_nothing_points_to_infinity(load: Load, listen: Listen) -> None:
    keys = "<topicName>cloud</topicName>"
    sim = load(world("libgazebo_ros_block_laser.so", keys, x=90.0))
    clouds = listen(sim, "/cloud")
    sim.run(seconds=0.1)
    assert {point.x for point in clouds[-1].points} == {math.inf}
