"""No broken map for any of 20 seeds and 20 sets of parameters around the defaults.

python benchmarks/soak/slam_robustness.py ARCHIVE [RUNS]     (intel.npz)

A seed disturbs the log: odometry's steps by 2 cm and 1° and a share of 5 %, ranges by 1 cm, every
50th scan is left out. A set of parameters multiplies each by 0.8 … 1.25. A map is broken when its
trajectory is more than 0.5 m off gmapping's, root mean square.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import fields, replace
from pathlib import Path

import numpy as np

from gazelle.diagnostics import Diagnostics
from gazelle.mapping.logs import LogRecord, read_log
from gazelle.mapping.poses import between, compose
from gazelle.mapping.relations import absolute_error_m, relation_errors
from gazelle.mapping.slam import Slam, SlamParameters

BROKEN_M = 0.5
FIXED = ("loop_closing", "polish")


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
    changed = {}
    for one in fields(SlamParameters):
        value = getattr(plain, one.name)
        if one.name not in FIXED:
            scaled = value * np.exp(rng.uniform(np.log(0.8), np.log(1.25)))
            changed[one.name] = round(scaled) if isinstance(value, int) else float(scaled)
    return replace(plain, **changed)


def main() -> int:
    path = Path(sys.argv[1])
    runs = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    data, records = np.load(path), list(read_log(path, Diagnostics()))
    broken = 0
    for seed in range(runs):
        worse, kept = disturbed(records, seed)
        cases = (
            ("seed", worse, kept, SlamParameters()),
            ("parameters", records, np.arange(len(records)), varied(seed)),
        )
        for name, log, indices, parameters in cases:
            broken += _is_broken(f"{name} {seed}", log, data, indices, parameters)
    print(f"{broken} of {2 * runs} maps are broken")
    return 1 if broken else 0


def _is_broken(
    name: str, log: Sequence[LogRecord], data: object, indices: np.ndarray, told: SlamParameters
) -> bool:
    engine = Slam(told)
    for record in log:
        engine.add(*record)
    engine.finish()
    off_m = absolute_error_m(engine.trajectory(), data["ref"][indices])  # type: ignore[index]
    place = {int(k): n for n, k in enumerate(indices)}
    rows = [
        (place[i], place[j], rel)
        for i, j, rel in zip(data["ri"], data["rj"], data["rel"][:, [2, 3, 7]], strict=True)  # type: ignore[index]
        if i in place and j in place
    ]
    first, second, relative = (np.array(column) for column in zip(*rows, strict=True))
    errors = relation_errors(engine.trajectory(), first, second, relative)
    print(f"{name}: {off_m:.3f} m off gmapping, {errors}", flush=True)
    return off_m > BROKEN_M


if __name__ == "__main__":
    sys.exit(main())
