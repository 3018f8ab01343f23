"""Stereo: two cameras of one sensor see the same thing apart by f · b / z."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.interfaces import message_type
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

WIDTH_PX, FOV_RAD, BASELINE_M, DISTANCE_M = 160, 1.0, 0.2, 2.0
FOCAL_PX = WIDTH_PX / (2 * math.tan(FOV_RAD / 2))
CAMERA = f"""<camera name="{{name}}"><pose>0 {{y}} 0 0 0 0</pose>
  <horizontal_fov>{FOV_RAD}</horizontal_fov>
  <image><width>{WIDTH_PX}</width><height>40</height><format>R8G8B8</format></image>
  <clip><near>0.05</near><far>20</far></clip></camera>"""
# A dark post straight ahead of the left camera, before a grey sky.
WORLD = """<sdf version="1.6"><world name="w">
  <scene><ambient>1 1 1 1</ambient><background>.7 .7 .7 1</background></scene>
  <model name="head"><static>true</static><link name="eyes">
    <sensor name="stereo" type="multicamera"><update_rate>10</update_rate>{cameras}{plugin}
  </sensor></link></model>
  <model name="post"><static>true</static><pose>{x} 0 0 0 0 0</pose><link name="l">
    <visual name="v"><geometry><box><size>0.1 0.1 4</size></box></geometry>
      <material><ambient>0 0 0 1</ambient><diffuse>0 0 0 1</diffuse></material></visual>
  </link></model></world></sdf>"""
ROS1 = f"""<plugin name="p" filename="libgazebo_ros_multicamera.so">
  <robotNamespace>r</robotNamespace><cameraName>stereo</cameraName><imageTopicName>image_raw</imageTopicName>
  <cameraInfoTopicName>camera_info</cameraInfoTopicName><frameName>eyes</frameName>
  <hackBaseline>{BASELINE_M}</hackBaseline></plugin>"""
ROS2 = """<plugin name="p" filename="libgazebo_ros_camera.so"><ros><namespace>/r</namespace></ros>
  <camera_name>stereo</camera_name><frame_name>eyes</frame_name></plugin>"""


def world(plugin: str, names: tuple[str, ...] = ("left", "right")) -> str:
    cameras = "".join(
        CAMERA.format(name=name, y=-number * BASELINE_M) for number, name in enumerate(names)
    )
    return WORLD.format(cameras=cameras, plugin=plugin, x=DISTANCE_M + 0.05)


def column_of_the_post(message: Any) -> float:
    pixels = np.asarray(message.data).reshape(message.height, message.width, 3)
    dark = np.flatnonzero(pixels[20].mean(axis=1) < 60)
    return float(dark.mean())


@pytest.mark.parametrize("plugin", [ROS1, ROS2])
def test_the_disparity_is_focal_length_times_baseline_over_depth(
    load: Load, listen: Listen, plugin: str
) -> None:
    sim = load(world(plugin))
    left, right = (listen(sim, f"/r/stereo/{side}/image_raw") for side in ("left", "right"))
    sim.run(seconds=0.3)
    assert len(left) == len(right) == 3
    assert left[-1].header.stamp == right[-1].header.stamp
    assert left[-1].header.frame_id == "eyes"
    disparity = column_of_the_post(left[-1]) - column_of_the_post(right[-1])
    assert disparity == pytest.approx(FOCAL_PX * BASELINE_M / DISTANCE_M, abs=0.75)


def test_the_right_cameras_projection_has_the_baseline(load: Load, listen: Listen) -> None:
    sim = load(world(ROS1))
    left, right = (listen(sim, f"/r/stereo/{side}/camera_info") for side in ("left", "right"))
    sim.run(seconds=0.2)
    assert left[-1].p[3] == 0.0
    assert right[-1].p[3] == pytest.approx(-FOCAL_PX * BASELINE_M)
    assert left[-1].p[0] == right[-1].p[0] == pytest.approx(FOCAL_PX)


def test_a_camera_that_is_neither_left_nor_right_is_reported(load: Load) -> None:
    sim = load(world(ROS1, ("left", "middle")))
    (found,) = sim.diagnostics.by_code("parameter.bad-value")
    assert (
        "camera 'middle' of sensor 'head::eyes::stereo::middle' is neither left nor right"
        in found.message
    )
    topics = sim.server.node.topics  # type: ignore[attr-defined]
    assert "/r/stereo/left/image_raw" in topics
    assert not any("middle" in topic for topic in topics)


def test_a_multicamera_read_on_demand_gives_every_picture(load: Load) -> None:
    records = load(world(ROS1)).sensor("stereo").read()
    assert len(records) == 2
    assert not np.array_equal(records[0].rgb, records[1].rgb)


def test_a_prosilica_streams_like_a_camera(load: Load, listen: Listen) -> None:
    plugin = ROS1.replace("multicamera", "prosilica").replace("</plugin>", "")
    plugin += "<pollServiceName>request_image</pollServiceName></plugin>"
    text = world(plugin, ("only",)).replace('type="multicamera"', 'type="camera"')
    sim = load(text)
    pictures = listen(sim, "/r/stereo/image_raw")
    sim.run(seconds=0.2)
    assert len(pictures) == 2
    assert column_of_the_post(pictures[-1]) == pytest.approx((WIDTH_PX - 1) / 2, abs=0.75)


TRIGGERED = ROS1.replace("ros_multicamera", "ros_triggered_camera").replace(
    f"<hackBaseline>{BASELINE_M}</hackBaseline>", "<triggerTopicName>shoot</triggerTopicName>"
)


@pytest.mark.parametrize(
    ("plugin", "trigger"),
    [
        (TRIGGERED, "/r/stereo/shoot"),
        (
            ROS2.replace("</plugin>", "<triggered>true</triggered></plugin>"),
            "/r/stereo/image_trigger",
        ),
    ],
)
def test_a_triggered_camera_takes_one_picture_for_each_trigger(
    load: Load, listen: Listen, plugin: str, trigger: str
) -> None:
    text = world(plugin, ("only",)).replace('type="multicamera"', 'type="camera"')
    sim = load(text)
    pictures = listen(sim, "/r/stereo/image_raw")
    sim.run(seconds=0.5)
    assert pictures == []
    empty = message_type("std_msgs/Empty")()
    for count in (1, 2):
        for _ in range(count):
            sim.publish(trigger, empty)
        sim.run(seconds=0.3)
    stamps = [message.header.stamp.nanosec // 10**6 for message in pictures]
    assert stamps == [501, 801, 802]
