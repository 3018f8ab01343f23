"""How long SLAM takes per scan, and how good it is, on the log of the Intel Research Lab.

python benchmarks/bench_slam.py ARCHIVE      (intel.npz, with ref, ri, rj and rel)
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

from gazelle.diagnostics import Diagnostics
from gazelle.mapping.logs import read_log
from gazelle.mapping.relative_pose_error import absolute_error_m, relation_errors
from gazelle.mapping.slam import Slam


def main() -> None:
    path = Path(sys.argv[1])
    records, data = list(read_log(path, Diagnostics())), np.load(path)
    warm = Slam()
    for record in records[:60]:
        warm.add(*record)
    engine, times_s = Slam(), []
    for record in records:
        start_s = time.process_time()
        engine.add(*record)
        times_s.append(time.process_time() - start_s)
    start_s = time.process_time()
    engine.finish()
    last_s = time.process_time() - start_s
    total_s, lasted_s = sum(times_s) + last_s, float(data["t"][-1] - data["t"][0])
    print(
        f"{1e3 * total_s / len(records):.1f} ms a scan with the last pass ({last_s:.1f} s), median "
        f"{1e3 * np.median(times_s):.1f}, 99 % {1e3 * np.percentile(times_s, 99):.0f}, most "
        f"{1e3 * max(times_s):.0f} ms; {lasted_s / total_s:.0f} times real time"
    )
    pairs = data["ri"], data["rj"], data["rel"][:, [2, 3, 7]]
    print("gmapping:", relation_errors(data["ref"], *pairs))
    print("gazelle: ", relation_errors(engine.trajectory(), *pairs))
    off_m = absolute_error_m(engine.trajectory(), data["ref"])
    print(f"{off_m:.3f} m from gmapping's trajectory")


if __name__ == "__main__":
    main()
