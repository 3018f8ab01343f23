"""Time of the doctor from a cold process to its last finding, by what it is given.

Run ``python benchmarks/doctor_speed.py [NAME ...]``; prints one JSON object per target, medians of
several runs, each in a process of its own. Targets are made in a temporary folder: packages as
``gazelle new robot`` writes them, and robots of many links with inertias, visuals and limits:

- ``chain-N``: one behind the other, which the engine refuses beyond some hundred;
- ``arms-N``: arms of a hundred joints on one base;
- ``bare-N``: the same arms without inertias, so that each link is a finding.

`wall_s` counts everything, `cpu_s` the processor's time, which says more on a busy machine. Set
PYTHONDONTWRITEBYTECODE to nothing: a process that compiles Gazelle's modules takes twice as long.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

WANTED_S = {"new robot, ROS 1": 1, "new robot, ROS 2": 1, "chain-3000": 2, "chain-20000": 20,
            "arms-3000": None, "arms-20000": 20, "bare-3000": None}  # fmt: skip
_ARM = 100
_CODE = """
import json, resource, sys, time
start_s = time.process_time()
from gazelle.process_lifetime import collect_garbage_rarely
collect_garbage_rarely()  # as the command does
from gazelle.doctor import examine
imported_s = time.process_time()
report = examine(sys.argv[1:])
used = resource.getrusage(resource.RUSAGE_SELF)
print(json.dumps({"cpu_s": used.ru_utime + used.ru_stime, "import_s": imported_s - start_s,
                  "examine_s": time.process_time() - imported_s, "peak_mb": used.ru_maxrss / 1024,
                  "findings": len(report.findings), "exit_code": report.exit_code}))
"""
_INERTIAL = """<inertial><mass value="1"/>
      <inertia ixx="0.0017" ixy="0" ixz="0" iyy="0.0017" iyz="0" izz="0.0017"/></inertial>
"""


def main() -> None:
    """Measure everything, or what is named."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("name", nargs="*", help=f"of: {', '.join(WANTED_S)}")
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for name in options.name or WANTED_S:
            target = _target(name, Path(folder))
            _examined(target)
            runs = [_examined(target) for _ in range(options.runs)]
            medians = {
                key: round(statistics.median(run[key] for run in runs), 3) for key in runs[0]
            }
            print(json.dumps({"name": name, **medians, "wanted_s": WANTED_S.get(name)}), flush=True)


def robot_text(links: int, arm: int, *, has_inertia: bool = True) -> Iterator[str]:
    """Yield the lines of a robot with arms of so many links on its first one."""
    yield '<robot name="many">'
    for at in range(links):
        yield f'  <link name="link_{at}">'
        if has_inertia:
            yield _INERTIAL
        yield '    <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>\n  </link>'
        if at:
            above = 0 if (at - 1) % arm == 0 else at - 1
            yield f'  <joint name="joint_{at}" type="revolute">'
            yield f'    <parent link="link_{above}"/><child link="link_{at}"/>'
            yield '    <origin xyz="0 0 0.1"/><axis xyz="0 1 0"/>'
            yield '    <limit lower="-1.5" upper="1.5" effort="10" velocity="2"/>\n  </joint>'
    yield "</robot>"


def _target(name: str, folder: Path) -> Path:
    """Write what is examined."""
    if name.startswith("new robot"):
        version = name[-1]
        words = ["new", "robot", f"bot{version}", f"--ros{version}", "--into", str(folder)]
        command = [sys.executable, "-m", "gazelle.cli", *words]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return folder / f"bot{version}"
    kind, count = name.rsplit("-", 1)
    arm = int(count) if kind == "chain" else _ARM
    path = folder / f"{name}.urdf"
    path.write_text("\n".join(robot_text(int(count), arm, has_inertia=kind != "bare")), "utf-8")
    return path


def _examined(target: Path) -> dict[str, float]:
    environ = {key: text for key, text in os.environ.items() if key != "PYTHONDONTWRITEBYTECODE"}
    command = [sys.executable, "-c", _CODE, str(target)]
    start_s = time.perf_counter()
    done = subprocess.run(
        command, check=True, capture_output=True, text=True, env=environ, cwd=target.parent
    )
    found: dict[str, float] = {"wall_s": time.perf_counter() - start_s, **json.loads(done.stdout)}
    return found


if __name__ == "__main__":
    main()
