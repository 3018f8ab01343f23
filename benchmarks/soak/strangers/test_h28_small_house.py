"""The small house of AWS RoboMaker, for ROS 2 (ws) and ROS 1 (ws1)."""

from __future__ import annotations

import math
import time
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from stage import Seen, Stage

PACKAGE = "aws_robomaker_small_house_world"
ROS2 = f"ros2 launch {PACKAGE} small_house.launch.py gui:=false"
ROS1 = f"roslaunch {PACKAGE} small_house.launch"
LIDAR = """<sdf version="1.6"><model name="lidar"><static>true</static><link name="link">
<pose>0 0 0.3 0 0 0</pose><sensor name="lidar" type="ray"><update_rate>5</update_rate>
<always_on>true</always_on><ray><scan><horizontal><samples>360</samples><min_angle>-3.14159</min_angle>
<max_angle>3.14159</max_angle></horizontal></scan><range><min>0.1</min><max>30</max></range></ray>
<plugin name="scan" filename="libgazebo_ros_ray_sensor.so"><ros><remapping>~/out:=/scan</remapping>
</ros><output_type>sensor_msgs/LaserScan</output_type><frame_name>link</frame_name></plugin>
</sensor></link></model></sdf>"""


def world(folder: Path) -> ET.Element:
    found = ET.parse(folder / f"ws/src/{PACKAGE}/worlds/small_house.world").getroot().find("world")
    assert found is not None
    return found


def see(run: Seen) -> None:
    """Look at what both launches must show: loading and speed."""
    begun_s = time.monotonic()
    run.wait_until(0.5, 90.0)
    assert time.monotonic() - begun_s < 60.0
    first_sim_s, first_s = run.sim_time_s, time.monotonic()
    run.run_sim(5.0)
    assert (run.sim_time_s - first_sim_s) / (time.monotonic() - first_s) > 0.5
    # A mesh or texture that is not there is told once.
    told = [line for line in run.output.splitlines() if "not found" in line or "missing" in line]
    assert len(told) == len(set(told)), told


def test_the_world_is_as_its_file_says(stage: Stage) -> None:
    parts = world(stage.folder)
    models = parts.findall("model")
    # Two more models are inside another; they are not counted.
    assert len(models) == 87
    printed = stage.run(f"gz sdf -k ws/src/{PACKAGE}/worlds/small_house.world")
    assert printed.code == 0, printed.output
    assert "Check complete" in printed.output


def test_it_loads_and_runs_in_ros_2_and_a_lidar_sees_walls(stage: Stage) -> None:
    with stage.launch(ROS2) as run:
        see(run)
        listed = run.call("/get_model_list")
        assert len(listed.model_names) == 87
        spawned = stage.run("ros2 run gazebo_ros spawn_entity.py -stdin -entity lidar", stdin=LIDAR)
        assert spawned.code == 0, spawned.output
        scan = run.topic("/scan").next()
        near = [one for one in scan.ranges if math.isfinite(one) and one < 10.0]
        assert len(near) > 0.5 * len(scan.ranges)


def test_it_loads_and_runs_in_ros_1(stage: Stage) -> None:
    path = {"ROS_PACKAGE_PATH": str(stage.folder / "ws1/src")}
    with stage.launch(ROS1, env=path) as run:
        see(run)
        properties = run.call("/gazebo/get_world_properties")
        assert len(properties.model_names) == 87
        physics = run.call("/gazebo/get_physics_properties")
        assert physics.time_step == pytest.approx(0.001)
        assert physics.gravity.z == pytest.approx(-9.8)


def test_the_map_has_its_resolution_and_origin(stage: Stage) -> None:
    path = next((stage.folder / "ws/src").rglob("map.yaml"))
    server = f"ros2 run nav2_map_server map_server --ros-args -p yaml_filename:={path}"
    with stage.launch(server) as maps:
        maps.wait_for_node("/map_server")
        for step in ("configure", "activate"):
            assert "successful" in stage.run(f"ros2 lifecycle set /map_server {step}").output
        grid = maps.topic("/map", "nav_msgs/msg/OccupancyGrid").next()
        assert grid.info.resolution == pytest.approx(0.05)
        origin = grid.info.origin.position
        assert (origin.x, origin.y) == (-12.5, -12.5)
