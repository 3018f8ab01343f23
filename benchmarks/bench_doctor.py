"""Time of the doctor: a launch examined, apart from the import of what it needs.

Run ``python benchmarks/bench_doctor.py [TARGET ...] [name:=value ...]`` inside a workspace; prints
one JSON object per measurement, medians of several runs, each in a process of its own. The first
examination of a process is the one that counts: meshes are read, nothing is remembered.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys

_CODE = """
import json, sys, time
start = time.perf_counter()
import gazelle.control.controllers.registry, gazelle.simulator.plugins.registry
from gazelle.doctor import Options, examine
gazelle.simulator.plugins.registry.all_tables()
import gazelle.engine, gazelle.engine.mujoco_library, gazelle.sensors, scipy.spatial
from gazelle.diagnostics.catalogue import all_entries
all_entries()
import gazelle.simulator, xacro, collada, PIL.Image
words = json.loads(sys.argv[1])
targets = [word for word in words if ":=" not in word]
options = Options(dict(word.split(":=", 1) for word in words if ":=" in word))
imported = time.perf_counter()
report = examine(targets, options=options)
end = time.perf_counter()
print(json.dumps({"import_s": imported - start, "examine_s": end - imported,
                  "findings": len(report.findings), "exit_code": report.exit_code}))
"""


def main() -> None:
    """Measure everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("target", nargs="*", help="what gazelle doctor is given")
    parser.add_argument("--runs", type=int, default=5)
    options = parser.parse_args()
    words = options.target or ["gazebo_ros", "empty_world.launch"]
    runs = [_examined(words) for _ in range(options.runs + 1)][1:]
    print(
        json.dumps(
            {
                "name": f"doctor {' '.join(words)}",
                **{key: statistics.median(run[key] for run in runs) for key in runs[0]},
            }
        )
    )


def _examined(words: list[str]) -> dict[str, float]:
    command = [sys.executable, "-c", _CODE, json.dumps(words)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    found: dict[str, float] = json.loads(done.stdout)
    return found


if __name__ == "__main__":
    main()
