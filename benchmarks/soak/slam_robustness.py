"""No broken map for any of 20 seeds and 20 sets of parameters around the defaults.

python benchmarks/soak/slam_robustness.py ARCHIVE [--runs N] [--first N] [--jobs N]   (intel.npz)

A seed disturbs the log: odometry's steps by 2 cm and 1° and a share of 5 %, ranges by 1 cm, every
50th scan is left out. A set of parameters multiplies each by 0.8 … 1.25. A map is broken when its
trajectory is more than 0.5 m off gmapping's, root mean square.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import fields, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from gazelle.diagnostics import Diagnostics
from gazelle.mapping.logs import LogRecord, read_log
from gazelle.mapping.relative_pose_error import absolute_error_m, relation_errors
from gazelle.mapping.se2 import between, compose
from gazelle.mapping.slam import Slam, SlamParameters

BROKEN_M = 0.5
FIXED = ("loop_closing", "global_refinement")


def disturbed(records: Sequence[LogRecord], seed: int) -> tuple[list[LogRecord], np.ndarray]:
    """Return a worse log and the indices of the scans that are left."""
    rng = np.random.default_rng(seed)
    kept = np.flatnonzero(rng.random(len(records)) > 0.02)
    odometry = np.array([record.odometry for record in records])[kept]
    steps = between(odometry[:-1], odometry[1:])
    steps *= 1 + rng.normal(0, 0.05, steps.shape)
    steps += rng.normal(0, 1, steps.shape) * (0.02, 0.02, np.radians(1))
    poses = [odometry[0]]
    for step in steps:
        poses.append(compose(poses[-1], step))
    out = []
    for k, pose in zip(kept.tolist(), poses, strict=True):
        scan = records[k].scan
        noise = rng.normal(0, 0.01, len(scan.ranges_m))
        ranges = (scan.ranges_m + noise).astype(np.float32)
        out.append(LogRecord(replace(scan, ranges_m=ranges), pose))
    return out, kept


def varied(seed: int) -> SlamParameters:
    """Return parameters around the defaults."""
    rng = np.random.default_rng(1000 + seed)
    plain = SlamParameters()
    changed: dict[str, Any] = {}
    for one in fields(SlamParameters):
        value = getattr(plain, one.name)
        if one.name not in FIXED:
            scaled = value * np.exp(rng.uniform(np.log(0.8), np.log(1.25)))
            changed[one.name] = round(scaled) if isinstance(value, int) else float(scaled)
    return replace(plain, **changed)


class Case(NamedTuple):
    """One map to make."""

    path: Path
    seed: int
    is_disturbed: bool


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("archive", type=Path)
    parser.add_argument("--runs", type=int, default=20, help="seeds, and sets of parameters")
    parser.add_argument("--first", type=int, default=0, help="the first of them")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    told = parser.parse_args()
    seeds = range(told.first, told.first + told.runs)
    cases = [Case(told.archive, seed, kind) for seed in seeds for kind in (True, False)]
    broken = 0
    with ProcessPoolExecutor(told.jobs) as pool:
        for off_m, line in pool.map(_mapped, cases):
            print(line, flush=True)
            broken += off_m > BROKEN_M
    print(f"{broken} of {len(cases)} maps are broken")
    return 1 if broken else 0


def _mapped(case: Case) -> tuple[float, str]:
    """Return how far the trajectory is from gmapping's, metres, and a line about it."""
    data, records = np.load(case.path), list(read_log(case.path, Diagnostics()))
    indices, parameters = np.arange(len(records)), SlamParameters()
    if case.is_disturbed:
        records, indices = disturbed(records, case.seed)
    else:
        parameters = varied(case.seed)
    engine = Slam(parameters)
    for record in records:
        engine.add(*record)
    engine.finish()
    off_m = absolute_error_m(engine.trajectory(), data["ref"][indices])
    place = {int(k): n for n, k in enumerate(indices)}
    rows = [
        (place[i], place[j], rel)
        for i, j, rel in zip(data["ri"], data["rj"], data["rel"][:, [2, 3, 7]], strict=True)
        if i in place and j in place
    ]
    first, second, relative = (np.array(column) for column in zip(*rows, strict=True))
    errors = relation_errors(engine.trajectory(), first, second, relative)
    name = "seed" if case.is_disturbed else "parameters"
    return off_m, f"{name} {case.seed}: {off_m:.3f} m off gmapping, {errors}"


if __name__ == "__main__":
    sys.exit(main())
