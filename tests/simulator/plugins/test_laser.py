from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.geometry import Pose
from gazelle.simulator import Simulation
from gazelle.simulator.plugins.context import join_names

Load = Callable[..., Simulation]
Cart = Callable[..., str]
Listen = Callable[[Simulation, str], list[Any]]

WALL = """<sdf version="1.6"><model name="wall"><static>true</static><link name="link">
  <collision name="c"><geometry><box><size>0.2 8 2</size></box></geometry></collision>
  <visual name="v"><geometry><box><size>0.2 8 2</size></box></geometry></visual>
</link></model></sdf>"""


def with_plugin(text: str, plugin: str) -> str:
    first = text.index('<plugin name="laser"')
    last = text.index("</plugin>", first) + len("</plugin>")
    return text[:first] + plugin + text[last:]


def test_a_scan_of_a_wall_has_the_analytic_ranges(
    load: Load, cart_urdf: Cart, listen: Listen
) -> None:
    sim = load(cart_urdf())
    sim.spawn(WALL, pose=Pose((2.85, 0.0, 1.0)))
    scans = listen(sim, "/scan")
    sim.run(seconds=1.0)
    scan = scans[-1]
    assert [item.header.stamp.nanosec // 10**6 for item in scans[:3]] == [100, 200, 300]
    assert scan.header.frame_id == "laser"
    assert scan.angle_min == pytest.approx(-0.6)
    assert scan.angle_increment == pytest.approx(0.15)
    assert (scan.time_increment, scan.scan_time) == (0.0, 0.0)
    assert (scan.range_min, scan.range_max) == pytest.approx((0.05, 10.0))
    x = sim.link("base_link").pose.position_m[0]
    angles = -0.6 + 0.15 * np.arange(9)
    assert np.abs(scan.ranges - (2.75 - x) / np.cos(angles)).max() < 1e-3
    assert np.all(np.asarray(scan.intensities) == 0)


def test_beyond_the_range_is_infinite(load: Load, cart_urdf: Cart, listen: Listen) -> None:
    sim = load(cart_urdf(), world=None)
    scans = listen(sim, "/scan")
    sim.run(seconds=0.2)
    assert np.all(np.isposinf(scans[0].ranges))


@pytest.mark.parametrize("kind", ["LaserScan", "PointCloud", "PointCloud2", "Range"])
def test_the_ros_2_plug_in_offers_four_messages(
    load: Load, cart_urdf: Cart, listen: Listen, kind: str
) -> None:
    plugin = f"""<plugin name="scanner" filename="libgazebo_ros_ray_sensor.so">
      <ros><namespace>/demo</namespace><remapping>~/out:=cloud</remapping></ros>
      <output_type>sensor_msgs/{kind}</output_type><frame_name>laser</frame_name></plugin>"""
    sim = load(with_plugin(cart_urdf(), plugin))
    sim.spawn(WALL, pose=Pose((2.85, 0.0, 1.0)))
    messages = listen(sim, "/demo/cloud")
    sim.run(seconds=0.5)
    message = messages[-1]
    assert f"sensor_msgs/msg/{kind}" == type(message).TYPE_NAME
    assert message.header.frame_id == "laser"
    ahead = 2.75 - sim.link("base_link").pose.position_m[0]
    if kind == "LaserScan":
        assert message.ranges[4] == pytest.approx(ahead, abs=1e-3)
    elif kind == "PointCloud":
        assert [p.x for p in message.points] == pytest.approx([ahead] * 9, abs=2e-3)
        assert message.channels[0].name == "intensity"
    elif kind == "PointCloud2":
        points = np.frombuffer(np.asarray(message.data).tobytes(), np.float32).reshape(-1, 4)
        assert message.width == 9
        assert points[:, 0] == pytest.approx([ahead] * 9, abs=2e-3)
    else:
        assert message.range == pytest.approx(ahead, abs=2e-3)
        assert message.field_of_view == pytest.approx(1.2)


def test_an_unknown_output_type_is_reported(load: Load, cart_urdf: Cart) -> None:
    plugin = """<plugin name="scanner" filename="libgazebo_ros_ray_sensor.so">
      <output_type>sensor_msgs/LaserScn</output_type></plugin>"""
    sim = load(with_plugin(cart_urdf(), plugin))
    (found,) = sim.diagnostics.by_code("parameter.bad-value")
    assert "<output_type> is 'LaserScn'; PointCloud2 is used" in found.message
    assert "'LaserScan'" in found.fix
    assert sim.server.node.topics["/scanner/out"] == "sensor_msgs/msg/PointCloud2"  # type: ignore[attr-defined]


def test_the_tf_prefix_parameter_prefixes_the_frame(
    load: Load, cart_urdf: Cart, listen: Listen
) -> None:
    sim = load(world="empty")
    sim.server.node.parameters.set("/tf_prefix", "one")
    sim.spawn(cart_urdf())
    scans = listen(sim, "/scan")
    sim.run(seconds=0.2)
    assert scans[0].header.frame_id == "one/laser"


def test_names_are_joined_as_ros_does() -> None:
    assert join_names("/", "scan") == "/scan"
    assert join_names("//r", "a/b") == "/r/a/b"
    assert join_names("/r", "/scan") == "/scan"
