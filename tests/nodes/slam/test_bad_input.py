"""What SLAM says to bad input, once, and that it goes on afterwards."""

from __future__ import annotations

import importlib.util
import math
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.geometry import Pose
from gazelle.graph.tf import StampedPose
from gazelle.mapping.slam import SlamParameters
from gazelle.nodes.slam.parameters import SlamOptions


def _bench() -> Any:
    """The module beside this one; tests are imported without packages."""
    name = "slam_bench"
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(name, Path(__file__).parent / f"{name}.py")
        assert spec
        assert spec.loader
        sys.modules[name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules[name])
    return sys.modules[name]


b = _bench()
OPTIONS = replace(SlamOptions(), slam=SlamParameters(keyframe_m=0.2))


def _goes_on(drive: Any) -> None:
    """Good scans are mapped after the bad ones."""
    before = drive.used
    drive.drive(b.POSES[10:])
    assert drive.used == before + 10
    assert math.dist(drive.mapper.engine.pose[:2], b.POSES[-1][:2]) < 0.1


def _said(drive: Any, text: str) -> str:
    found = [one for one in drive.node.said if text in one]
    assert len(found) == 1, drive.node.said
    return str(found[0])


def test_a_scan_in_an_unknown_frame_is_told_once() -> None:
    drive = b.Drive(OPTIONS).drive(b.POSES[:10])
    drive.drive(b.POSES[9:10] * 30, frame="lidar")
    text = _said(drive, "a scan in frame 'lidar' is dropped")
    assert "publish the transforms odom → base_link → lidar" in text
    _goes_on(drive)


def test_a_loop_of_transforms_is_told_once() -> None:
    drive = b.Drive(OPTIONS).drive(b.POSES[:10])
    now_ns = drive.node.clock.time_ns
    for one in ("ring", "laser2"), ("laser2", "ring"):
        drive.tf.send([StampedPose(*one, now_ns, Pose())])
    drive.drive(b.POSES[9:10] * 30, frame="laser2")
    _said(drive, "a scan in frame 'laser2' is dropped")
    assert any("loop" in one for one in drive.node.said), drive.node.said
    _goes_on(drive)


def test_odometry_that_jumps_is_told_and_the_robot_stays() -> None:
    drive = b.Drive(OPTIONS).drive(b.POSES[:10])
    drive.node.clock.time_ns += b.STEP_NS
    drive.place((30.0, 5.0, 0.0))
    drive.scan(b.POSES[9])
    assert "30." in _said(drive, "odometry jumped by")
    assert math.dist(drive.mapper.engine.pose[:2], b.POSES[9][:2]) < 0.1


def test_scans_without_a_number_are_told_once() -> None:
    drive = b.Drive(OPTIONS).drive(b.POSES[:10])
    drive.drive(b.POSES[9:10] * 30, ranges=[math.nan] * 180)
    assert "all ranges are NaN" in _said(drive, "no beam of the scan met anything")
    _goes_on(drive)


def test_some_beams_that_are_no_numbers_do_not_matter() -> None:
    drive = b.Drive(OPTIONS)
    for pose in b.POSES[:10]:
        ranges = b.ranges(*pose)
        ranges[20:50] = [math.nan, -1.0, math.inf] * 10
        drive.step(pose, ranges=ranges)
    assert drive.node.said == []
    _goes_on(drive)


def test_another_number_of_beams_is_mapped_on() -> None:
    drive = b.Drive(OPTIONS).drive(b.POSES[:10])
    drive.drive(b.POSES[9:10] * 3, beams=90)
    drive.drive(b.POSES[9:10] * 3, beams=720)
    assert drive.node.said == []
    _goes_on(drive)


def test_a_scan_without_beams_or_directions_is_told() -> None:
    drive = b.Drive(OPTIONS).drive(b.POSES[:10])
    drive.drive(b.POSES[9:10] * 5, ranges=[])
    _said(drive, "no beam of the scan met anything")
    drive.drive(b.POSES[9:10] * 5, angle_increment=0.0)
    _said(drive, "beams have no directions")
    _goes_on(drive)


def test_a_scan_older_than_the_last_is_left_out_and_told_once() -> None:
    drive = b.Drive(OPTIONS).drive(b.POSES[:10])
    used, now_ns = drive.used, drive.node.clock.time_ns
    for _ in range(10):
        drive.node.clock.time_ns = now_ns - 3 * b.STEP_NS
        drive.scan(b.POSES[6])
    drive.node.clock.time_ns = now_ns
    _said(drive, "a scan is older than the last one")
    assert drive.used == used
    _goes_on(drive)


def test_a_reset_of_the_simulation_puts_the_robot_back_into_the_map() -> None:
    drive = b.Drive(OPTIONS).drive()
    kept = drive.kept
    drive.node.clock.jump(-900_000_000)
    drive.step(b.POSES[0])
    assert np.abs(drive.mapper.engine.pose - b.POSES[0]).max() < 0.05
    assert drive.node.said == []
    drive.drive(b.POSES[1:10])
    assert drive.kept >= kept
    _goes_on(drive)
