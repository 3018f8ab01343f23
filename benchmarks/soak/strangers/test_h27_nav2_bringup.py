"""Nav2's own bring-up of Humble: maps, parameters, the simulated TurtleBot3."""

from __future__ import annotations

import ast
import math
import re

import pytest
from stage import Stage, yaw_rad

MAPS = "nav2_map_server_test"
SIMULATION = "ros2 launch nav2_bringup tb3_simulation_launch.py headless:=True use_rviz:=False"
MODELS = "ws/src/turtlebot3_gazebo/models"


def server(path: object) -> str:
    return f"ros2 run nav2_map_server map_server --ros-args -p yaml_filename:={path}"


@pytest.mark.parametrize("ending", ["pgm", "png", "bmp"])
def test_the_map_is_the_one_of_the_packages_own_test(stage: Stage, ending: str) -> None:
    text = (stage.folder / MAPS / "test_constants.cpp").read_text()
    body = re.search(r"content\[\] = \{([^}]*)\}", text)
    assert body
    content = list(ast.literal_eval(f"[{body[1]}]"))
    described = (stage.folder / MAPS / "testmap.yaml").read_text()
    path = stage.home / "testmap.yaml"
    image = stage.folder / MAPS / f"testmap.{ending}"
    path.write_text(described.replace("testmap.png", str(image)))
    with stage.launch(server(path)) as maps:
        maps.wait_for_node("/map_server")
        for step in ("configure", "activate"):
            done = stage.run(f"ros2 lifecycle set /map_server {step}")
            assert "Transitioning successful" in done.output, done.output
        grid = maps.topic("/map", "nav_msgs/msg/OccupancyGrid").next()
        assert (grid.info.width, grid.info.height) == (10, 10)
        assert grid.info.resolution == pytest.approx(0.1)
        origin = grid.info.origin
        assert (origin.position.x, origin.position.y) == (2.0, 3.0)
        assert yaw_rad(origin.orientation) == pytest.approx(1.0)
        assert list(grid.data) == content


def test_an_image_that_is_not_there_fails_the_transition_and_the_node_lives(stage: Stage) -> None:
    with stage.launch(server(stage.folder / MAPS / "invalid_image.yaml")) as maps:
        maps.wait_for_node("/map_server")
        done = stage.run("ros2 lifecycle set /map_server configure")
        # The original's command ends with 0 here too.
        assert "Transitioning failed" in done.output, done.output
        assert re.search("Failed to load image file .*invalid.png", maps.output), maps.output
        state = stage.run("ros2 lifecycle get /map_server")
        assert "unconfigured" in state.output, state.output
        assert maps.exit_code is None


def test_gzserver_is_a_command_with_plugins_of_the_system(stage: Stage) -> None:
    world = "ws/src/nav2_bringup/worlds/world_only.model"
    plugins = "-s libgazebo_ros_init.so -s libgazebo_ros_factory.so"
    with stage.launch(
        f"gzserver {plugins} {world}", env={"GAZEBO_MODEL_PATH": str(stage.folder / MODELS)}
    ) as run:
        run.wait_until(1.0)
        run.wait_for_node("/gazebo")
        assert "/spawn_entity" in {one.name for one in run.graph.services()}


def test_the_waffle_navigates_in_its_world(stage: Stage) -> None:
    models = {"GAZEBO_MODEL_PATH": str(stage.folder / MODELS)}
    with stage.launch(SIMULATION, env=models) as nav:
        nav.wait_for_topics("/scan", "/odom", "/map")
        grid = nav.topic("/map", "nav_msgs/msg/OccupancyGrid").next()
        assert (grid.info.width, grid.info.height) == (384, 384)
        assert (grid.info.origin.position.x, grid.info.origin.position.y) == (-10.0, -10.0)
        x, y, *_ = stage.place("turtlebot3_waffle")
        assert (x, y) == pytest.approx((-2.0, -0.5), abs=0.02)
        scan = nav.topic("/scan").next()
        assert len(scan.ranges) == 360
        nav.has_rate("/scan", 5.0)
        nav.has_rate("/odom", 30.0)
        covariance = [0.0] * 36
        covariance[0] = covariance[7] = 0.25
        covariance[35] = 0.07
        nav.publish(
            "/initialpose",
            header={"frame_id": "map"},
            pose={
                "pose": {"position": {"x": -2.0, "y": -0.5}, "orientation": {"w": 1.0}},
                "covariance": covariance,
            },
        )
        nav.topic("/amcl_pose").next(60.0)
        nav.says(r"lifecycle_manager_navigation.*Managed nodes are active", 120.0)
        nav.wait_for_topics("/global_costmap/costmap", "/local_costmap/costmap", "/tf")
        costmap = nav.topic("/global_costmap/costmap", "nav_msgs/msg/OccupancyGrid").next()
        assert costmap.info.width == 384
        local = nav.topic("/local_costmap/costmap", "nav_msgs/msg/OccupancyGrid").next()
        assert local.header.frame_id == "odom"
        read = stage.run("ros2 param get /controller_server controller_frequency")
        assert "20" in read.output, read.output
        commands = nav.topic("/cmd_vel")
        begun_s = nav.sim_time_s
        sent = stage.run(
            "ros2 action send_goal /navigate_to_pose nav2_msgs/action/NavigateToPose "
            '"{pose: {header: {frame_id: map}, pose: '
            '{position: {x: 0.5, y: 0.5}, orientation: {w: 1.0}}}}"',
            timeout_s=400.0,
        )
        took_s = nav.sim_time_s - begun_s
        assert "SUCCEEDED" in sent.output, sent.output
        assert took_s < 120.0
        commands.next()
        x, y, *_ = stage.place("turtlebot3_waffle")
        assert math.hypot(x - 0.5, y - 0.5) < 0.4


@pytest.mark.parametrize("name", ["map_circular", "keepout_mask", "speed_mask"])
def test_the_maps_of_the_system_tests_load(stage: Stage, name: str) -> None:
    # empty_room.yaml names an image that is not there, upstream as well.
    path = stage.folder / "nav2_system_tests/maps" / f"{name}.yaml"
    with stage.launch(server(path)) as maps:
        maps.wait_for_node("/map_server")
        assert "successful" in stage.run("ros2 lifecycle set /map_server configure").output
        assert "successful" in stage.run("ros2 lifecycle set /map_server activate").output
        assert maps.topic("/map", "nav_msgs/msg/OccupancyGrid").next().info.width > 0
