"""Logs of robots as files."""

from __future__ import annotations

import gzip
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.mapping.logs import (
    LogRecord,
    duration_s,
    read_log,
    stamp_problem,
    write_carmen,
    write_tum,
)

OLD = """# CARMEN Logfile
PARAM laser_front_laser_resolution 1
ODOM 0.5 0.2 0.1 0 0 0 12.0 host 12.0
FLASER 4 1.00 2.00 81.83 4.00 1.10 0.50 0.10 1.00 0.50 0.10 12.5 host 0.5
"""
NEW = """PARAM robot_frontlaser_offset 0.1
ROBOTLASER1 0 -1.5 3.0 1.5 30.0 0.01 0 3 1.0 30.0 2.0 0 1.1 0.5 0.1 1.0 0.5 0.1 0 0 0 0 0 12.5 h 0.5
"""


def _read(path: Path) -> tuple[list[LogRecord], Diagnostics]:
    diagnostics = Diagnostics()
    return list(read_log(path, diagnostics)), diagnostics


def _written(folder: Path, text: str) -> Path:
    path = folder / "robot.log"
    path.write_text(text)
    return path


def test_flaser_lines_give_scan_odometry_and_mounting(tmp_path: Path) -> None:
    records, diagnostics = _read(_written(tmp_path, OLD))
    assert not len(diagnostics)
    scan, odometry = records[0]
    assert odometry.tolist() == [1.0, 0.5, 0.1]
    assert scan.stamp_ns == 12_500_000_000
    assert scan.hits().tolist() == [True, True, False, True]
    assert scan.angle_min_rad == pytest.approx(-math.pi / 2)
    assert scan.angle_increment_rad == pytest.approx(math.pi / 4)
    # 0.1 m ahead in the map, which the robot sees turned by its own heading.
    assert scan.T_base_laser[:2] == pytest.approx((0.1 * math.cos(0.1), -0.1 * math.sin(0.1)))


def test_logs_packed_by_gzip_are_read_as_they_are(tmp_path: Path) -> None:
    plain, _ = _read(_written(tmp_path, OLD))
    packed = tmp_path / "robot.log.gz"
    packed.write_bytes(gzip.compress(OLD.encode()))
    records, diagnostics = _read(packed)
    assert not len(diagnostics)
    assert records[0].odometry.tolist() == plain[0].odometry.tolist()
    assert records[0].scan.ranges_m.tolist() == plain[0].scan.ranges_m.tolist()


def test_damaged_and_endless_logs_are_refused(tmp_path: Path, monkeypatch: Any) -> None:
    packed = tmp_path / "robot.log.gz"
    # Numbers that do not repeat, so that a half of the bytes is not all of the text.
    body = OLD + "".join(f"ODOM {math.sin(k)} 0 0 0 0 0 0 h 0\n" for k in range(20_000))
    packed.write_bytes(gzip.compress(body.encode())[:-20_000])
    with pytest.raises(OSError, match="the file is damaged"):
        _read(packed)
    packed.write_bytes(gzip.compress(OLD.encode() + b"1" * (5 << 20)))
    with pytest.raises(OSError, match="a line is longer than 4194304 bytes"):
        _read(packed)
    monkeypatch.setenv("GAZELLE_LIMITS", "1e-9")
    with pytest.raises(OSError, match=r"it is longer than 4 bytes; .*GAZELLE_LIMITS=10"):
        _read(_written(tmp_path, OLD))


@pytest.mark.parametrize(
    ("stamps_s", "problem", "lasted_s"),
    [
        ([1.0, 2.0, 4.0], "", 3.0),
        ([5.0], "", 0.0),
        ([0.0, 0.0, 0.0], "all 3 scans have the same stamp, 0 s", 0.0),
        ([9.0, 2.0, 3.0], "stamps of scans go back, or leap by more than a day, 1 times, first "
                          "from 9 s to 2 s (scan 1)", 0.0),
        ([1.0, 2.0, 1e9], "stamps of scans go back, or leap by more than a day, 1 times, first "
                          "from 2 s to 1e+09 s (scan 2)", 0.0),
    ],
)  # fmt: skip
def test_stamps_that_tell_no_time_are_told(
    stamps_s: list[float], problem: str, lasted_s: float
) -> None:
    stamps_ns = [round(stamp * 1e9) for stamp in stamps_s]
    assert stamp_problem(stamps_ns) == problem
    assert duration_s(stamps_ns) == lasted_s


def test_robotlaser_lines_bring_their_own_angles(tmp_path: Path) -> None:
    records, diagnostics = _read(_written(tmp_path, NEW))
    assert not len(diagnostics)
    scan, odometry = records[0]
    assert odometry.tolist() == [1.0, 0.5, 0.1]
    assert scan.angles_rad.tolist() == [-1.5, 0.0, 1.5]
    assert scan.hits().tolist() == [True, False, True]


def test_with_181_beams_both_ends_are_measured(tmp_path: Path) -> None:
    ranges = " ".join(["1.0"] * 181)
    records, _ = _read(_written(tmp_path, f"FLASER 181 {ranges} 0 0 0 0 0 0 1.0 h 1.0\n"))
    assert records[0].scan.angles_rad[[0, -1]] == pytest.approx([-math.pi / 2, math.pi / 2])


@pytest.mark.parametrize("ranges", ["0", "1 2.0"])
def test_scans_of_no_beam_and_of_one_are_read(ranges: str, tmp_path: Path) -> None:
    records, said = _read(_written(tmp_path, f"FLASER {ranges} 0 0 0 0 0 0 1.0 h 1.0\n"))
    assert len(records[0].scan.ranges_m) == int(ranges[0])
    assert not list(said)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("FLASER 4 1.0 2.0", "the line ends too early"),
        ("FLASER x 1.0", "invalid literal"),
        ("FLASER 2 1 1 0 0 nan 0 0 0 1.0 h 1.0", "is no pose"),
        ("ROBOTLASER1 0 -1.5 3.0 1.5 30 0.01 0 999999999 1", "is no number of beams"),
    ],
)
def test_broken_lines_are_told_and_left_out(tmp_path: Path, line: str, words: str) -> None:
    records, diagnostics = _read(_written(tmp_path, f"{line}\n{OLD}"))
    assert len(records) == 1
    (found,) = diagnostics.by_code("mapping.bad-line")
    assert words in found.message
    assert found.span and found.span.line == 1


def test_archives_give_what_they_hold(tmp_path: Path) -> None:
    path = tmp_path / "log.npz"
    np.savez(
        path, t=[1.0, 2.0], scans=[[1.0, 25.0], [2.0, 3.0]], odo=np.array([[0, 0, 0], [1, 0, 0.1]])
    )
    records, diagnostics = _read(path)
    assert not len(diagnostics)
    assert [record.scan.hits().tolist() for record in records] == [[True, False], [True, True]]
    assert records[1].odometry.tolist() == [1.0, 0.0, 0.1]


def test_archives_without_odometry_say_what_they_hold(tmp_path: Path) -> None:
    path = tmp_path / "log.npz"
    np.savez(path, t=[1.0], scans=[[1.0]], odom=[[0, 0, 0]])
    records, diagnostics = _read(path)
    assert not records
    (found,) = diagnostics.by_code("mapping.log-unreadable")
    assert "has no odo, but odom, scans, t" in found.message
    assert "did you mean 'odom'" in found.message


def test_archives_whose_sizes_differ_are_told(tmp_path: Path) -> None:
    path = tmp_path / "log.npz"
    np.savez(path, t=[1.0, 2.0], scans=[[1.0]], odo=[[0, 0, 0]])
    (found,) = _read(path)[1].by_code("mapping.log-unreadable")
    assert "t is (2,), scans (1, 1), odo (1, 3)" in found.message


@pytest.mark.parametrize("name", ["log.npz", "log.txt"])
def test_what_is_no_log_is_told(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    path.write_text("hello\n")
    (found,) = _read(path)[1].by_code("mapping.log-unreadable")
    assert "numpy archive" in found.message or "no CARMEN log" in found.message


def test_a_carmen_log_that_is_written_reads_back_with_its_new_poses(tmp_path: Path) -> None:
    records, _ = _read(_written(tmp_path, OLD))
    poses = np.array([[7.0, 8.0, -0.5]])
    again = tmp_path / "corrected.log"
    write_carmen(again, records, poses)
    (back,) = _read(again)[0]
    np.testing.assert_allclose(back.odometry, poses[0])
    np.testing.assert_allclose(back.scan.T_base_laser, records[0].scan.T_base_laser, atol=1e-5)
    np.testing.assert_array_equal(back.scan.hits(), records[0].scan.hits())


def test_a_trajectory_is_written_as_tum_does(tmp_path: Path) -> None:
    path = tmp_path / "path.tum"
    write_tum(path, [1_500_000_000], np.array([[1.0, -2.0, math.pi / 2]]))
    expected = "1.500000000 1.000000 -2.000000 0 0 0 0.707106781 0.707106781\n"
    assert path.read_text() == expected
