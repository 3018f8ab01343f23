"""Records as notebooks show them."""

from __future__ import annotations

import base64
import io
import math
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from gazelle.bag import create_bag, open_bag
from gazelle.bag.types import cdr_connection
from gazelle.description.loader import load_models
from gazelle.diagnostics import Diagnostics, Severity, SourceSpan
from gazelle.geometry import Pose
from gazelle.graph.tf import TransformBuffer
from gazelle.interfaces import message_type, ros1_message_type, to_cdr
from gazelle.mapping.grids import OccupancyGrid
from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.slam.slam_engine import SlamResult
from gazelle.motion.planning.problem import Path as JointPath
from gazelle.motion.timing.trajectory import Trajectory
from gazelle.navigation.costmap.cost_grid import CostGrid
from gazelle.navigation.planners.planner import Plan
from gazelle.sensors import CameraRecord, LidarRecord, ScanAngles
from gazelle.workspace import Workspace

_MAX_BYTES = 1_000_000


def _room(side: int) -> OccupancyGrid:
    cells = np.zeros((side, side), np.int8)
    cells[0] = cells[-1] = 100
    cells[: side // 2] = np.where(cells[: side // 2] == 0, -1, cells[: side // 2])
    return OccupancyGrid(cells, 0.05)


def _lidar(rows: int, columns: int) -> LidarRecord:
    angles = ScanAngles(
        np.linspace(-math.pi, math.pi, columns), np.linspace(-0.2, 0.2, rows), 0.1, 0.1
    )
    ranges = np.full((rows, columns), 3.0, np.float32)
    ranges[:, ::5] = np.inf
    return LidarRecord(ranges, np.zeros_like(ranges), angles)


def _trajectory(count: int) -> Trajectory:
    times = np.linspace(0.0, 4.0, count)
    values = np.stack([np.sin(times), np.cos(times)], axis=1)
    return Trajectory(("shoulder", "</script><b>"), times, values, values, values)


def _frames() -> TransformBuffer:
    buffer = TransformBuffer()
    for parent, child in (("map", "odom"), ("odom", "base"), ("x", "y"), ("y", "x")):
        buffer.set_transform(parent, child, 1, Pose((1.0, 0.0, 0.0)))
    return buffer


def _of(name: str, /, **fields: Any) -> Any:
    return message_type(name)(**fields)


def _joint_trajectory() -> Any:
    points = [
        _of("trajectory_msgs/JointTrajectoryPoint", positions=[0.1 * number],
            time_from_start=_of("builtin_interfaces/Duration", sec=number))
        for number in range(4)
    ]  # fmt: skip
    return _of("trajectory_msgs/JointTrajectory", joint_names=["elbow"], points=points)


def _transforms() -> Any:
    one = _of("geometry_msgs/TransformStamped", child_frame_id="base")
    one.header.frame_id = "odom"
    return _of("tf2_msgs/TFMessage", transforms=[one])


def _cloud() -> Any:
    fields = [
        _of("sensor_msgs/PointField", name=name, offset=4 * number, datatype=7, count=1)
        for number, name in enumerate("xyz")
    ]
    points = np.random.default_rng(1).normal(size=(500, 3)).astype("<f4")
    return _of(
        "sensor_msgs/PointCloud2", height=1, width=500, fields=fields, point_step=12,
        row_step=6000, data=points.tobytes(),
    )  # fmt: skip


_RGB = np.full((6, 8, 3), 90, np.uint8)
_DEPTH = np.linspace(1.0, 4.0, 48, dtype=np.float32).reshape(6, 8)
_SCAN_FIELDS: dict[str, Any] = {"angle_increment": 0.01, "range_max": 5.0, "ranges": [1.0] * 200}

_SHOWN: dict[str, Any] = {
    "a camera's picture": lambda: CameraRecord(_RGB, None),
    "a picture with its depth": lambda: CameraRecord(_RGB, _DEPTH),
    "a flat scan": lambda: _lidar(1, 360),
    "a scan of a million beams": lambda: _lidar(1, 1_000_000),
    "a scan that met nothing": lambda: Scan(0, 0.0, 0.1, np.full(9, np.inf, np.float32), 0.1, 9.0),
    "a scan of many rows": lambda: _lidar(16, 100),
    "a map": lambda: _room(80),
    "a map of 4096 by 4096 cells": lambda: _room(4096),
    "a map without cells": lambda: OccupancyGrid(np.zeros((1, 1), np.int8), 1.0),
    "costs": lambda: CostGrid(np.full((40, 40), 254, np.uint8), 0.1),
    "costs of 4096 by 4096 cells": lambda: CostGrid(np.full((4096, 4096), 255, np.uint8), 0.1),
    "a plan": lambda: Plan(np.zeros((50, 3)), 1.0),
    "a plan of a million poses": lambda: Plan(np.random.default_rng(1).normal(size=(10**6, 3)), 1),
    "a map of SLAM": lambda: SlamResult(np.zeros(2, np.int64), np.zeros((2, 3)), _room(50), 1),
    "a trajectory": lambda: _trajectory(100),
    "a trajectory of a million samples": lambda: _trajectory(1_000_000),
    "a planned path": lambda: JointPath(("a",), np.array([[0.0], [1.0]]), "RRT"),
    "a tree of frames": _frames,
    "a message": lambda: _of("nav_msgs/Odometry"),
    "a message of ROS 1": ros1_message_type("nav_msgs/Odometry"),
    "an image": lambda: _of(
        "sensor_msgs/Image", width=8, height=6, step=24, encoding="rgb8", data=_RGB.tobytes()
    ),
    "a message with a scan": lambda: _of("sensor_msgs/LaserScan", **_SCAN_FIELDS),
    "a message with a cloud": _cloud,
    "a message with joints": lambda: _of("sensor_msgs/JointState", name=["a"], position=[1.0]),
    "a message with a trajectory": _joint_trajectory,
    "a message with transforms": _transforms,
    "a message with a path": lambda: _of("nav_msgs/Path", poses=[_of("geometry_msgs/PoseStamped")]),
    "an empty map's message": lambda: _of("nav_msgs/OccupancyGrid"),
    "diagnostics of a robot": lambda: _of(
        "diagnostic_msgs/DiagnosticArray", status=[_of("diagnostic_msgs/DiagnosticStatus")]
    ),
}


@pytest.mark.parametrize("name", _SHOWN)
def test_a_record_shows_itself_within_bounds(name: str) -> None:
    bundle = _SHOWN[name]()._repr_mimebundle_()
    assert "text/html" in bundle
    assert sum(map(len, bundle.values())) < _MAX_BYTES
    for svg in re.findall(r"<svg.*?</svg>", bundle["text/html"], re.DOTALL):
        ElementTree.fromstring(svg)
    if "image/png" in bundle:
        Image.open(io.BytesIO(base64.b64decode(bundle["image/png"]))).load()


def test_names_of_a_chart_cannot_end_its_script() -> None:
    html = _trajectory(10)._repr_mimebundle_()["text/html"]
    assert html.count("</script>") == 1
    assert "<b>" not in html


def test_a_chart_keeps_its_peaks_however_many_samples_it_has() -> None:
    times = np.arange(100_000.0)
    values = np.zeros((100_000, 1))
    values[54_321] = 7.5
    html = Trajectory(("a",), times, values, values, values)._repr_mimebundle_()["text/html"]
    assert "7.5" in html[html.index("<script>") :]


def test_a_thin_wall_stays_in_a_large_map() -> None:
    cells = np.zeros((4000, 4000), np.int8)
    cells[1234] = 100
    bundle = OccupancyGrid(cells, 0.05)._repr_mimebundle_()
    picture = np.asarray(Image.open(io.BytesIO(base64.b64decode(bundle["image/png"]))))
    assert max(picture.shape) <= 960
    assert (picture == 0).any(axis=0).all()


def test_what_cannot_be_shown_is_left_to_the_text() -> None:
    broken = _of("sensor_msgs/Image", width=8, height=6, encoding="rgb8", data=b"")
    assert broken._repr_mimebundle_() == {}


def test_a_notebook_gets_the_kinds_it_asks_for() -> None:
    plan = Plan(np.zeros((3, 3)), 1.0)
    assert set(plan._repr_mimebundle_(include={"image/png"})) == {"image/png"}
    assert set(plan._repr_mimebundle_(exclude={"image/png"})) == {"text/html"}


def test_findings_are_shown_with_the_line_of_the_file(tmp_path: Path) -> None:
    file = tmp_path / "robot.urdf"
    file.write_text('<robot name="r">\n  <link nmae="<base>"/>\n</robot>\n')
    found = Diagnostics()
    span = SourceSpan(str(file), 2, 9, 4)
    found.report(
        "bag.unindexed", "a 'thing' & more", span, fix="write name", severity=Severity.ERROR
    )
    html = found._repr_mimebundle_()["text/html"]
    assert "1 error" in html
    assert f"{file}:2:9" in html
    assert ">nmae</span>" in html
    assert "&lt;base&gt;" in html
    assert "a &#x27;thing&#x27; &amp; more" in html
    assert "write name" in html


def test_no_findings_are_said_to_be_none() -> None:
    assert "nothing to complain about" in Diagnostics()._repr_mimebundle_()["text/html"]


def test_a_bag_and_its_messages_show_themselves(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    message = message_type("std_msgs/String")(data="hello")
    writer = create_bag(path, "mcap")
    connection = writer.add(cdr_connection("/chatter", "std_msgs/msg/String"))
    writer.write(connection, 1_000_000_000, to_cdr(message))
    writer.close()
    bag = open_bag(path)
    shown = bag._repr_mimebundle_()["text/html"]
    (one,) = bag.messages()
    bag.close()
    assert "/chatter" in shown
    assert "run.mcap (mcap): 1 messages" in shown
    assert "hello" in one._repr_mimebundle_()["text/html"]


def test_a_robot_shows_its_picture_and_its_tree() -> None:
    text = '<robot name="r"><link name="base"><visual><geometry><box size="1 1 1"/></geometry>'
    text += '</visual></link><link name="arm"/><joint name="elbow" type="fixed"><parent link='
    text += '"base"/><child link="arm"/></joint></robot>'
    found = Diagnostics()
    (model,) = load_models(text, workspace=Workspace.discover(), diagnostics=found)
    bundle = model._repr_mimebundle_()
    assert "elbow (fixed)" in bundle["text/html"]
    assert "image/png" in bundle
