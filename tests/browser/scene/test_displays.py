"""Every display draws what is published, under RViz's names."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.browser.scene.rviz_page import RvizPage, stamped

pytestmark = pytest.mark.slow


def _pose(x: float, y: float, yaw: float = 0.0) -> dict[str, Any]:
    return {
        "position": {"x": x, "y": y, "z": 0.0},
        "orientation": {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)},
    }


def _keep(bench: Any, topic: str, type_name: str, **fields: Any) -> None:
    bench.keep_publishing(topic, type_name, lambda _: fields, hz=4)


def test_scan_shows_one_point_per_ray_and_decays(rviz: RvizPage, bench: Any) -> None:
    scan = {
        "header": stamped("base_link"),
        "angle_min": -1.0,
        "angle_max": 1.0,
        "angle_increment": 0.02,
        "range_min": 0.1,
        "range_max": 10.0,
        "ranges": [2.0] * 100 + [math.inf],
    }
    _keep(bench, "/scan", "sensor_msgs/msg/LaserScan", **scan)
    rviz.add("/scan", "LaserScan")
    rviz.shows("LaserScan", points=100, clouds=1)
    rviz.set("LaserScan", "Decay Time", "2")
    rviz.eventually(lambda: rviz.counts("LaserScan")["clouds"] > 2)
    rviz.set("LaserScan", "Decay Time", "0")
    rviz.shows("LaserScan", clouds=1)
    assert rviz.display("LaserScan")["level"] == "ok"


def test_cloud_keeps_its_colours_and_a_budget(rviz: RvizPage, bench: Any) -> None:
    xyz = np.random.default_rng(1).uniform(-1, 1, (5000, 3)).astype(np.float32)
    fields = [
        {"name": name, "offset": 4 * index, "datatype": 7, "count": 1}
        for index, name in enumerate("xyz")
    ]
    cloud = {
        "header": stamped("base_link"),
        "height": 1,
        "width": 5000,
        "fields": fields,
        "point_step": 12,
        "row_step": 60000,
        "data": xyz.tobytes(),
        "is_dense": True,
    }
    _keep(bench, "/points", "sensor_msgs/msg/PointCloud2", **cloud)
    rviz.add("/points", "PointCloud2")
    rviz.shows("PointCloud2", points=5000)
    rviz.set("PointCloud2", "Color Transformer", "AxisColor")
    rviz.set("PointCloud2", "Style", "Spheres")
    rviz.set("PointCloud2", "Size (m)", "0.05")
    rviz.shows("PointCloud2", points=5000)
    rviz.seen.shot()


def test_map_path_and_poses_lie_in_the_fixed_frame(rviz: RvizPage, bench: Any) -> None:
    cells = np.zeros((40, 60), np.int8)
    cells[0], cells[:, 0], cells[20:, 30:] = 100, 100, -1
    info = {"resolution": 0.05, "width": 60, "height": 40, "origin": _pose(-1, -1)}
    _keep(
        bench, "/map", "nav_msgs/msg/OccupancyGrid", header=stamped(), info=info, data=cells.ravel()
    )
    steps = [{"header": stamped(), "pose": _pose(0.2 * i, 0.1 * i)} for i in range(12)]
    _keep(bench, "/plan", "nav_msgs/msg/Path", header=stamped(), poses=steps)
    cloud = [_pose(math.cos(i), math.sin(i), i) for i in range(200)]
    _keep(bench, "/particlecloud", "geometry_msgs/msg/PoseArray", header=stamped(), poses=cloud)
    _keep(bench, "/goal", "geometry_msgs/msg/PoseStamped", header=stamped(), pose=_pose(1, 1))
    rviz.add("/map", "Map")
    rviz.add("/plan", "Path")
    rviz.add("/particlecloud", "PoseArray")
    rviz.add("/goal", "Pose")
    rviz.shows("Map", width=60, height=40)
    rviz.shows("Path", poses=12)
    rviz.shows("PoseArray", poses=200)
    rviz.shows("Pose", poses=1)
    rviz.set("Map", "Color Scheme", "costmap")
    rviz.set("Path", "Line Style", "Billboards")
    rviz.set("Pose", "Shape", "Axes")
    rviz.eventually(lambda: rviz.report()["calls"] < 40)
    rviz.seen.shot()


def test_odometry_keeps_arrows_of_the_way(rviz: RvizPage, bench: Any) -> None:
    covariance = np.zeros(36)
    covariance[[0, 7, 35]] = 0.04, 0.01, 0.1

    def fields(t: float) -> dict[str, Any]:
        pose = {"pose": _pose(0.5 * t, 0.0), "covariance": covariance}
        return {"header": stamped("odom"), "child_frame_id": "base_link", "pose": pose}

    bench.keep_publishing("/odom", "nav_msgs/msg/Odometry", fields, hz=10)
    rviz.add("/odom", "Odometry")
    rviz.eventually(lambda: rviz.counts("Odometry").get("arrows", 0) > 5)
    rviz.set("Odometry", "Keep", "3")
    rviz.shows("Odometry", arrows=3, covariances=3)


def test_single_sensor_displays_draw(rviz: RvizPage, bench: Any) -> None:
    header = stamped("base_link")
    _keep(bench, "/imu", "sensor_msgs/msg/Imu", header=header, linear_acceleration={"z": 9.81})
    sonar = {"range": 1.5, "min_range": 0.1, "max_range": 4.0, "field_of_view": 0.5}
    _keep(bench, "/sonar", "sensor_msgs/msg/Range", header=header, **sonar)
    wrench = {"force": {"x": 5.0}, "torque": {"z": 3.0}}
    _keep(bench, "/wrench", "geometry_msgs/msg/WrenchStamped", header=header, wrench=wrench)
    point = {"x": 1.0, "y": 1.0, "z": 0.0}
    _keep(bench, "/point", "geometry_msgs/msg/PointStamped", header=header, point=point)
    corners = [{"x": x, "y": y} for x, y in ((0, 0), (1, 0), (1, 1))]
    _keep(
        bench,
        "/footprint",
        "geometry_msgs/msg/PolygonStamped",
        header=header,
        polygon={"points": corners},
    )
    _keep(bench, "/warmth", "sensor_msgs/msg/Temperature", header=header, temperature=21.0)
    cells = [{"x": 0.1 * i} for i in range(7)]
    _keep(
        bench,
        "/cells",
        "nav_msgs/msg/GridCells",
        header=header,
        cell_width=0.1,
        cell_height=0.1,
        cells=cells,
    )
    with_covariance = {"pose": _pose(1, 0), "covariance": np.eye(6).ravel() * 0.1}
    _keep(
        bench,
        "/amcl_pose",
        "geometry_msgs/msg/PoseWithCovarianceStamped",
        header=header,
        pose=with_covariance,
    )
    wanted = {
        "/imu": ("Imu", {"arrows": 1}),
        "/sonar": ("Range", {"cones": 1}),
        "/wrench": ("Wrench", {"arrows": 2}),
        "/point": ("PointStamped", {"points": 1}),
        "/warmth": ("Temperature", {"points": 1}),
        "/footprint": ("Polygon", {"corners": 3}),
        "/cells": ("GridCells", {"cells": 7}),
        "/amcl_pose": ("PoseWithCovariance", {"poses": 1, "covariances": 1}),
    }
    for topic, (display, _) in wanted.items():
        rviz.add(topic, display)
    for display, counts in wanted.values():
        rviz.shows(display, **counts)
    rviz.seen.shot()


def test_frames_have_names_axes_and_arrows_to_their_parents(rviz: RvizPage) -> None:
    rviz.row("TF").get_by_role("checkbox", name="Show TF").check()
    rviz.shows("TF", frames=3, names=3, arrows=2)
    rviz.set("TF", "Show Names", False)
    rviz.shows("TF", frames=3, names=0, arrows=2)
    rviz.seen.shot()


def test_fixed_frame_without_a_way_is_told_as_rviz_tells_it(rviz: RvizPage, bench: Any) -> None:
    _keep(bench, "/goal", "geometry_msgs/msg/PoseStamped", header=stamped("moon"), pose=_pose(1, 1))
    rviz.add("/goal", "Pose")
    rviz.eventually(lambda: rviz.display("Pose")["level"] == "error")
    assert "[moon]" in rviz.display("Pose")["status"]["Transform"]
    frame = rviz.seen.panel("displays").get_by_label("Fixed Frame")
    frame.fill("moon")
    frame.press("Enter")
    rviz.eventually(lambda: rviz.display("Pose")["level"] == "ok")
    rviz.shows("Pose", poses=1)


def test_hidden_display_costs_no_messages(rviz: RvizPage, bench: Any) -> None:
    _keep(bench, "/goal", "geometry_msgs/msg/PoseStamped", header=stamped(), pose=_pose(1, 1))
    rviz.add("/goal", "Pose")
    rviz.shows("Pose", poses=1)
    rviz.row("Pose").get_by_role("checkbox", name="Show Pose").uncheck()
    rviz.eventually(lambda: bench.graph.subscription_count("/goal") == 0)
