"""Do robots cross narrow fields, whatever follows their path?

    python benchmarks/soak/narrow_fields.py [--fields N] [--first N] [--controllers NAME ...]

Fields, robots and controllers of ``tests/navigation/narrow_fields.py``. Prints a JSON object a
controller, and exits with 1 when one crossed fewer than 48 of 50, touched something, or was still
about its goal after five minutes.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.navigation.narrow_fields import DRIVERS, cross

_MIN_SHARE = 0.96


def main() -> int:
    """Drive, print, judge."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fields", type=int, default=50)
    parser.add_argument("--controllers", nargs="+", default=list(DRIVERS), choices=list(DRIVERS))
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()
    bad = False
    for name in options.controllers:
        crossed = 0
        others: dict[int, str] = {}
        contacts, times = 0, []
        for seed in range(options.first, options.first + options.fields):
            end, run = cross(seed, name)
            crossed += end == "crossed"
            contacts += run.contacts > 0
            times.append(run.time_s)
            if end != "crossed" or run.contacts:
                place = ", ".join(f"{value:.2f}" for value in run.pose)
                others[seed] = (
                    f"{run.robot.name} after {run.time_s:.0f} s, {run.contacts} contacts and "
                    f"{run.recoveries} recoveries at {place}: {end[:150]}"
                )
        print(json.dumps({"controller": name, "fields": options.fields, "crossed": crossed,
                          "with_contact": contacts, "median_s": round(float(np.median(times)), 1),
                          "others": others}), flush=True)  # fmt: skip
        stands = any("still about it" in one for one in others.values())
        bad |= crossed < _MIN_SHARE * options.fields or contacts > 0 or stands
    return int(bad)


if __name__ == "__main__":
    sys.exit(main())
