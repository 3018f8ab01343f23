from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.simulator import Simulation

WORLD = """<sdf version="1.9"><world name="lab">
  <plugin filename="gz-sim-physics-system" name="gz::sim::systems::Physics"/>
  <plugin filename="gz-sim-sensors-system" name="gz::sim::systems::Sensors"/>
  <model name="post"><static>true</static><link name="head"><sensor name="s" type="{kind}">
    <update_rate>20</update_rate>{topic}
    {spec}</sensor></link></model>
  <model name="wall"><static>true</static><pose>3.1 0 0 0 0 0</pose><link name="l">
    <collision name="c"><geometry><box><size>0.2 8 8</size></box></geometry></collision>
    <visual name="v"><geometry><box><size>0.2 8 8</size></box></geometry></visual></link></model>
</world></sdf>"""
CAMERA = """<camera><horizontal_fov>1</horizontal_fov><image><width>32</width><height>24</height>
  </image><clip><near>0.1</near><far>10</far></clip></camera>"""
LIDAR = """<ray><scan><horizontal><samples>3</samples><min_angle>-0.1</min_angle>
  <max_angle>0.1</max_angle></horizontal></scan><range><min>0.1</min><max>9</max></range></ray>"""
OWN = "<topic>own</topic>"


@pytest.mark.parametrize(
    ("kind", "spec", "topic", "wanted"),
    [
        ("gpu_lidar", LIDAR, OWN, {"/own": "LaserScan", "/own/points": "PointCloud2"}),
        ("imu", "", OWN, {"/own": "Imu"}),
        ("imu", "", "", {"/world/lab/model/post/link/head/sensor/s/imu": "Imu"}),
        ("camera", CAMERA, OWN, {"/own": "Image", "/camera_info": "CameraInfo"}),
        ("depth_camera", CAMERA, OWN, {"/own": "Image", "/own/points": "PointCloud2"}),
        (
            "rgbd_camera",
            CAMERA,
            OWN,
            {
                "/own/image": "Image",
                "/own/depth_image": "Image",
                "/own/points": "PointCloud2",
                "/own/camera_info": "CameraInfo",
            },
        ),
    ],
)
def test_sensors_of_gz_worlds_publish_by_themselves(
    load: Callable[..., Simulation],
    tmp_path: Any,
    listen: Callable[..., list[Any]],
    kind: str,
    spec: str,
    topic: str,
    wanted: dict[str, str],
) -> None:
    path = tmp_path / "lab.sdf"
    path.write_text(WORLD.format(kind=kind, spec=spec, topic=topic))
    sim = load(world=path)
    messages = {name: listen(sim, name) for name in wanted}
    sim.run(seconds=0.5)
    for name, type_name in wanted.items():
        assert len(messages[name]) == 10, name
        assert f"sensor_msgs/msg/{type_name}" == type(messages[name][0]).TYPE_NAME
        assert messages[name][0].header.frame_id == "post/head/s"
    if kind == "gpu_lidar":
        assert messages["/own"][0].ranges[1] == pytest.approx(3.0, abs=1e-3)
    if kind == "depth_camera":
        depth = np.asarray(messages["/own"][0].data).view(np.float32)
        assert np.abs(depth - 3.0).max() < 1e-3


def test_the_system_of_sensors_may_stand_in_a_model(
    load: Callable[..., Simulation], tmp_path: Any, listen: Callable[..., list[Any]]
) -> None:
    text = WORLD.format(kind="gpu_lidar", spec=LIDAR, topic=OWN)
    lines = [line for line in text.splitlines() if "<plugin" not in line]
    system = '<plugin filename="ignition-gazebo-sensors-system" name="gz::sim::systems::Sensors"/>'
    text = "\n".join(lines).replace('<model name="wall">', f'<model name="wall">{system}')
    path = tmp_path / "lab.sdf"
    path.write_text(text)
    sim = load(world=path)
    messages = listen(sim, "/own")
    sim.run(seconds=0.5)
    assert len(messages) == 10


def test_sensors_of_other_worlds_need_their_plug_in(
    load: Callable[..., Simulation], tmp_path: Any
) -> None:
    path = tmp_path / "lab.world"
    text = WORLD.format(kind="gpu_lidar", spec=LIDAR, topic=OWN)
    lines = [line for line in text.splitlines() if "<plugin" not in line]
    path.write_text("\n".join(lines))
    assert load(world=path).server.node.topics == {}  # type: ignore[attr-defined]
