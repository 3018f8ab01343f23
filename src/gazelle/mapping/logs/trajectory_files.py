"""Writing trajectories."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from gazelle.geometry import quat_xyzw_from_yaw
from gazelle.mapping.logs.log_record import LogRecord
from gazelle.mapping.se2 import Poses, compose

__all__ = ["write_carmen", "write_tum"]


def write_tum(path: Path, stamps_ns: Iterable[int], poses: Poses) -> None:
    """Write ``time x y z qx qy qz qw`` in every line, as TUM's tools and evo read it.

    The poses are (n, 3): x, y (m) and yaw (rad) in the map, one for each stamp.
    """
    lines = []
    for stamp, (x, y, yaw) in zip(map(int, stamps_ns), poses.tolist(), strict=True):
        _, _, z, w = quat_xyzw_from_yaw(yaw)
        lines.append(f"{stamp / 1e9:.9f} {x:.6f} {y:.6f} 0 0 0 {z:.9f} {w:.9f}\n")
    path.write_text("".join(lines))


def write_carmen(path: Path, records: Iterable[LogRecord], poses: Poses) -> None:
    """Write the log anew with other poses: a corrected log of FLASER lines.

    Args:
        path: of the new log.
        records: n of the old one.
        poses: (n, 3) of the robot in the map: x, y (m) and yaw (rad).
    """
    lines = []
    for record, pose in zip(records, poses, strict=True):
        scan = record.scan
        lidar = compose(pose, scan.T_base_laser)
        seen = scan.hits()
        ranges = [f"{r:.3f}" if ok else f"{scan.range_max_m + 1:.2f}"
                 for r, ok in zip(scan.ranges_m.tolist(), seen.tolist(), strict=True)]  # fmt: skip
        numbers = [f"{value:.6f}" for value in (*lidar, *pose)]
        time_s = f"{scan.stamp_ns / 1e9:.6f}"
        lines.append(
            " ".join(["FLASER", str(len(ranges)), *ranges, *numbers, time_s, "gazelle", time_s])
        )
    path.write_text("\n".join(lines) + "\n")
