"""``gazelle slam`` on logs of every format."""

from __future__ import annotations

import gzip
import math
from pathlib import Path

import numpy as np
import pytest

from gazelle.bag import Storage, cdr_connection, create_bag
from gazelle.cli.slam import main
from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import fill, message_type, to_cdr
from gazelle.mapping.grids import read_map

WALLS = np.array([(-3, -2), (3, -2), (3, 2), (-3, 2), (-3, -2)], dtype=float)


def _ranges(x: float, y: float, yaw: float) -> np.ndarray:
    """Distances from inside a room of 6 × 4 m, one beam per 2°."""
    angles = yaw + np.radians(np.arange(0, 360, 2))
    cos, sin = np.cos(angles), np.sin(angles)
    with np.errstate(divide="ignore"):
        across = np.where(cos > 0, (3 - x) / cos, (-3 - x) / cos)
        along = np.where(sin > 0, (2 - y) / sin, (-2 - y) / sin)
    return np.minimum(across, along)


POSES = [(0.1 * k - 1, 0.05 * k - 0.5, 0.05 * k) for k in range(20)]


@pytest.fixture
def archive(tmp_path: Path) -> Path:
    path = tmp_path / "room.npz"
    np.savez(
        path,
        t=np.arange(len(POSES)) * 0.2,
        scans=[_ranges(*pose) for pose in POSES],
        odo=POSES,
        angle_min=0.0,
        angle_increment=math.radians(2),
    )
    return path


def test_a_log_becomes_map_and_trajectory(
    archive: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    relations = tmp_path / "room.relations"
    relations.write_text("0.0 0.2 0.1 0.05 0 0 0 0.05\n7 8 0 0 0 0 0 0\n")
    stem = tmp_path / "out"
    assert main([str(archive), "-o", str(stem), "--relations", str(relations), "--carmen"]) == 0
    out = capsys.readouterr().out
    assert f"wrote {stem}.pgm, {stem}.yaml, {stem}.tum, {stem}.log" in out
    assert "20 scans, 2 m driven" in out
    assert "1 relations: translation 0.0" in out
    assert "(1 relations have no scans at their times)" in out
    grid = read_map(Path(f"{stem}.yaml"), Diagnostics())
    assert grid is not None
    assert grid.width * 0.05 == pytest.approx(6.2, abs=0.3)
    assert len(Path(f"{stem}.tum").read_text().splitlines()) == 20


def test_stamps_that_tell_no_time_are_told_and_no_speed_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "room.log.gz"
    lines = [
        f"FLASER 181 {' '.join(['2.0'] * 181)} {k} 0 0 {k} 0 0 {stamp} h {stamp}"
        for k, stamp in enumerate((9.0, 4e9, 5.0))
    ]
    path.write_bytes(gzip.compress("\n".join(lines).encode()))
    assert main([str(path), "-o", str(tmp_path / "out")]) == 0
    told = capsys.readouterr()
    assert "stamps of scans go back, or leap by more than a day, 2 times" in told.err
    assert "[mapping.stamps]" in told.err
    assert "3 scans, " in told.out
    assert "times real time" not in told.out


def test_a_bag_is_placed_by_its_transforms(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "room.mcap"
    _write_bag(path)
    assert main([str(path), "-o", str(tmp_path / "out")]) == 0
    assert "20 scans, 2 m driven" in capsys.readouterr().out


def test_a_bag_whose_lidar_has_no_frame_says_which_transforms_are_missing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "room.mcap"
    _write_bag(path, frame="laser_2")
    assert main([str(path), "-o", str(tmp_path / "out")]) == 1
    error = capsys.readouterr().err
    assert "[mapping.scan-without-pose]" in error
    assert "20 scans of /scan are left out: a scan in frame 'laser_2' is dropped" in error
    assert "[mapping.no-scans]" in error
    assert not (tmp_path / "out.pgm").exists()


def test_a_wrong_topic_is_told_with_the_right_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "room.mcap"
    _write_bag(path)
    assert main([str(path), "--scan", "/scam"]) == 1
    assert "did you mean '/scan'" in capsys.readouterr().err


@pytest.mark.parametrize("text", [None, "nothing of a log\n"])
def test_what_is_no_log_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str | None
) -> None:
    path = tmp_path / "room.bag"
    if text is not None:
        path.write_text(text)
    assert main([str(path)]) == 1
    assert "[mapping.log-unreadable]" in capsys.readouterr().err


def _write_bag(path: Path, frame: str = "laser") -> None:
    writer = create_bag(path, Storage.MCAP)
    scans = writer.add(cdr_connection("/scan", "sensor_msgs/msg/LaserScan"))
    moving = writer.add(cdr_connection("/tf", "tf2_msgs/msg/TFMessage"))
    static = writer.add(cdr_connection("/tf_static", "tf2_msgs/msg/TFMessage"))
    writer.write(static, 0, _transform("base_footprint", "laser", (0.0, 0.0, 0.0), 0))
    for k, pose in enumerate(POSES):
        stamp_ns = k * 200_000_000 + 1_000_000_000
        writer.write(moving, stamp_ns, _transform("odom", "base_footprint", pose, stamp_ns))
        writer.write(scans, stamp_ns, _scan(pose, frame, stamp_ns))
    writer.close()


def _scan(pose: tuple[float, float, float], frame: str, stamp_ns: int) -> bytes:
    scan = message_type("sensor_msgs/msg/LaserScan")()
    fill(scan, {"angle_min": 0.0, "angle_increment": math.radians(2), "range_min": 0.1,
                "range_max": 20.0, "ranges": _ranges(*pose).tolist()})  # fmt: skip
    _stamp(scan, frame, stamp_ns)
    return to_cdr(scan)


def _transform(parent: str, child: str, pose: tuple[float, float, float], stamp_ns: int) -> bytes:
    one = message_type("geometry_msgs/msg/TransformStamped")(child_frame_id=child)
    one.transform.translation.x, one.transform.translation.y = pose[:2]
    one.transform.rotation.z, one.transform.rotation.w = (
        math.sin(pose[2] / 2),
        math.cos(pose[2] / 2),
    )
    _stamp(one, parent, stamp_ns)
    return to_cdr(message_type("tf2_msgs/msg/TFMessage")(transforms=[one]))


def _stamp(message: object, frame: str, stamp_ns: int) -> None:
    header = message.header  # type: ignore[attr-defined]
    header.frame_id = frame
    header.stamp.sec, header.stamp.nanosec = divmod(stamp_ns, 1_000_000_000)
