"""Maps of public logs: none broken, for any of 20 seeds of odometry's noise.

python benchmarks/soak/slam_logs.py FOLDER [--seeds N] [--first N] [--jobs N] [--only NAME ...]

FOLDER holds CARMEN logs whose poses were corrected (``aces-corrected.log.gz`` …), as the Robotics
Data Set Repository (Radish) and others publish them; nobody's copy is part of Gazelle. Their poses
are the truth that a map is measured against. Odometry is made of them: steps of the robot are off
by a share of 5 %, by 2 cm and 1°. A trajectory is judged after alignment: root mean square of the
distances over the diagonal of what was driven, 1 % at most.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np

from gazelle.diagnostics import Diagnostics
from gazelle.mapping.logs import LogRecord, read_log
from gazelle.mapping.relative_pose_error import absolute_error_m
from gazelle.mapping.se2 import Poses, between, compose
from gazelle.mapping.slam import Slam

MAX_SHARE = 0.01


class Mapped(NamedTuple):
    """One map.

    Attributes:
        log: name of the file.
        seed: of odometry's noise.
        scans: how many.
        size_m: diagonal of what was driven.
        off_m: root mean square error of the trajectory.
        odometry_m: the same of odometry alone.
        loops: closures.
        took_s: to map it.
        crash: what ended it, empty when nothing did.
    """

    log: str
    seed: int
    scans: int
    size_m: float
    off_m: float
    odometry_m: float
    loops: int
    took_s: float
    crash: str = ""

    @property
    def is_broken(self) -> bool:
        """Whether it crashed, or is off by more than is allowed."""
        return bool(self.crash) or not self.off_m <= MAX_SHARE * self.size_m


def main() -> int:
    """Print a line for each map and a table of all logs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=1, help="the first seed")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--only", nargs="*", default=[], help="beginnings of names")
    told = parser.parse_args()
    paths = sorted(path for path in told.folder.iterdir() if path.name.endswith((".log", ".gz")))
    paths = [one for one in paths if not told.only or one.name.startswith(tuple(told.only))]
    cases = [(path, seed) for path in paths for seed in range(told.first, told.first + told.seeds)]
    done: list[Mapped] = []
    with ProcessPoolExecutor(told.jobs) as pool:
        for one in pool.map(_mapped, cases):
            done.append(one)
            print(_line(one), flush=True)
    broken = sum(one.is_broken for one in done)
    print(_table(done))
    print(f"{broken} of {len(done)} maps are broken")
    return 1 if broken or not done else 0


def noisy(truth: Poses, seed: int) -> Poses:
    """Return odometry (n, 3) that drifts from the true poses."""
    rng = np.random.default_rng(seed)
    steps = between(truth[:-1], truth[1:])
    steps *= 1 + rng.normal(0, 0.05, steps.shape)
    steps += rng.normal(0, 1, steps.shape) * (0.02, 0.02, np.radians(1))
    poses = [truth[0]]
    for step in steps:
        poses.append(compose(poses[-1], step))
    return np.array(poses)


def _mapped(case: tuple[Path, int]) -> Mapped:
    path, seed = case
    records = list(read_log(path, Diagnostics()))
    truth = np.array([record.odometry for record in records])
    size_m = float(np.hypot(*np.ptp(truth[:, :2], axis=0)))
    odometry = noisy(truth, seed)
    name = path.name.partition(".")[0]
    made = Mapped(
        name, seed, len(records), size_m, np.inf, absolute_error_m(odometry, truth), 0, 0.0
    )
    start_s = time.perf_counter()
    try:
        engine = _engine(records, odometry)
    except Exception as error:  # noqa: BLE001 - whatever it is, it is a finding
        return made._replace(crash=f"{type(error).__name__}: {error}")
    return made._replace(
        off_m=absolute_error_m(engine.trajectory(), truth),
        loops=engine.loops,
        took_s=time.perf_counter() - start_s,
    )


def _engine(records: Sequence[LogRecord], odometry: Poses) -> Slam:
    engine = Slam()
    for record, pose in zip(records, odometry, strict=True):
        engine.add(record.scan, pose)
    engine.finish()
    return engine


def _line(one: Mapped) -> str:
    what = one.crash or f"{one.off_m:.3f} m off, odometry {one.odometry_m:.1f} m"
    mark = "  BROKEN" if one.is_broken else ""
    return f"{one.log} seed {one.seed}: {what}, {one.loops} loops, {one.took_s:.0f} s{mark}"


def _table(done: Sequence[Mapped]) -> str:
    rows = ["log                        scans  size m  median m   worst m  allowed  broken"]
    for log in dict.fromkeys(one.log for one in done):
        own = [one for one in done if one.log == log]
        off = [one.off_m for one in own]
        first = own[0]
        rows.append(
            f"{log:<26}{first.scans:>6}{first.size_m:>8.1f}{np.median(off):>10.3f}"
            f"{max(off):>10.3f}{MAX_SHARE * first.size_m:>9.2f}"
            f"{sum(one.is_broken for one in own):>5}/{len(own)}"
        )
    return "\n".join(rows)


if __name__ == "__main__":
    sys.exit(main())
