"""Does a TurtleBot3 map its world, find itself and drive to goals, run after run?

    python benchmarks/soak/navigation.py [--workspaces DIR] [--models burger waffle] [--seeds N]
                                         [--goals N] [--factor F]

The commands of TurtleBot3's manual with its packages as published: world, SLAM and keyboard, map
saver, navigation; then random goals, one that cannot be reached, a box in the way, a kidnapping.
Simulated time runs F times faster than real time, where the machine can. Exit code 1 when a run has
a contact, fewer than 19 of 20 goals reached within their tolerance, or something else goes wrong.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from tests.conftest import Launched  # noqa: E402
from tests.tutorial.turtlebot3_run import Report, scripted_run  # noqa: E402
from tests.tutorial.turtlebot3_session import Session  # noqa: E402

PORT = 7841
TOLERANCE_M, TOLERANCE_RAD = 0.05, 0.17
# Localisation goes on after the end of a goal, and may see it a little differently then.
LATER_M, LATER_RAD = 0.02, 0.1


@contextlib.contextmanager
def commands(home: Path) -> Iterator[Any]:
    """Give what runs ``gazelle WORDS…``; everything ends with the context."""
    running: list[Launched] = []

    def run(*words: str, cwd: Path, stdin: Any = None, **environ: str) -> Launched:
        clean = {k: v for k, v in os.environ.items() if not k.startswith(("ROS_", "GAZELLE_"))}
        own = {"GAZELLE_PORT": str(PORT), "ROS_HOME": str(home / "ros"), "GAZELLE_STUDIO": "0"}
        full = {**clean, **own, "HOME": str(home), **environ}
        command = [sys.executable, "-m", "gazelle.cli", *words]
        running.append(Launched(command, port=PORT, cwd=cwd, environ=full, stdin=stdin))
        return running[-1]

    try:
        yield run
    finally:
        for one in reversed(running):
            one.close()


def reached(report: Report) -> int:
    """Return how many goals were reached within their tolerance."""
    return sum(
        one.text == "Goal reached."
        and one.believed[0] <= TOLERANCE_M + LATER_M
        and one.believed[1] <= TOLERANCE_RAD + LATER_RAD
        for one in report.arrivals
    )


def is_good(report: Report) -> bool:
    """Tell whether everything went as it should."""
    return (
        reached(report) >= 0.95 * len(report.arrivals)
        and "The goal (0.00, 0.00)" in report.refusal
        and report.around_box == report.after_kidnap == "Goal reached."
        and report.updates_when_found is not None
        and not report.bumps
        and report.looks > 100
    )


def main() -> int:
    """Run and judge."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workspaces", type=Path, default=ROOT.parent / "shared" / "workspaces")
    parser.add_argument("--models", nargs="+", default=["burger", "waffle"])
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--goals", type=int, default=20)
    parser.add_argument("--factor", type=float, default=3.0)
    options = parser.parse_args()
    bad = 0
    for model in options.models:
        for seed in range(options.seeds):
            with tempfile.TemporaryDirectory() as folder, commands(Path(folder)) as run:
                began = time.monotonic()
                session = Session(run, options.workspaces / "turtlebot3_ws", model)
                session.hurry(options.factor)

                def say(text: str, began: float = began) -> None:
                    print(f"  {time.monotonic() - began:6.1f} s: {text}", flush=True)

                report = scripted_run(
                    session, Path(folder), model=model, goals=options.goals, seed=seed, say=say
                )
            bad += not is_good(report)
            print(
                f"{model} {seed}: {reached(report)} of {len(report.arrivals)} goals, "
                f"{len(report.bumps)} contacts in {report.looks} looks, box: {report.around_box} "
                f"found after {report.updates_when_found} updates, then {report.after_kidnap} "
                f"refusal: {report.refusal} contacts: {report.bumps[:20]}",
                flush=True,
            )
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
