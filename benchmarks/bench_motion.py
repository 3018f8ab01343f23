"""Speed of motion planning: 100 random problems of each of three arms among ten obstacles.

Prints medians of CPU milliseconds: the search, its shortcuts and both together (wanted: 10 at
most), the last check, and the time parameterisation with its checks. Problems with
a straight solution count too; the line below leaves them out. With OMPL installed
(``pip install "gazelle-sim[ompl]"``) its RRTConnect solves the same problems over the same
collision checker. LUCK is left out where the sample workspaces are missing.
"""

from __future__ import annotations

import json
import statistics
import sys
import time
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from tests.motion.problems import REACHES_M, Case, case_of, robot_named

from gazelle.motion.planning import PlannerSettings, PlanningError, Search, plan
from gazelle.motion.planning.ompl_planners import solver, why_missing
from gazelle.motion.planning.problem import Problem
from gazelle.motion.timing import parameterise

_FILE = Path(__file__).parents[1] / "tests" / "motion" / "planning_verdicts.json"
_COLUMNS = ("search", "shortcuts", "both", "check", "times")


def main() -> None:
    """Print one block per arm."""
    print(f"{'CPU ms, medians':28}" + "".join(f"{name:>11}" for name in _COLUMNS))
    for name in REACHES_M:
        try:
            robot = robot_named(name)
        except (AssertionError, OSError) as error:
            print(f"{name}: left out ({type(error).__name__})")
            continue
        rows = json.loads(_FILE.read_text(encoding="utf-8"))[name]
        cases = [case_of(robot, name, *row[:3]) for row in rows if row[3]]
        # All clocks count CPU time, so that other programs do not matter.
        with mock.patch("time.perf_counter", time.process_time):
            found = [figures for case in cases if (figures := _own(case)) is not None]
        _print(f"{name}, {len(found)} of {len(cases)} solved", [row[:-1] for row in found])
        _print("  those with corners", [row[:-1] for row in found if row[-1]])
        if not why_missing("RRTConnect"):
            with mock.patch("time.perf_counter", time.process_time):
                peer = statistics.median(_ompl(case) for case in cases)
            print(f"{'  OMPL, RRTConnect':28}{peer:11.2f}")


def _own(case: Case) -> tuple[float, ...] | None:
    try:
        path = plan(
            case.space, case.checker, case.start, [case.goal], search=Search(time_limit_s=60.0)
        )
    except PlanningError as error:
        print(f"  {case.number}: {error}")
        return None
    begin = time.process_time()
    parameterise(path, case.space, validity=case.checker)
    timing = time.process_time() - begin
    search, short = path.planning_time_s, path.simplification_time_s
    parts = (search, short, search + short, path.validation_time_s, timing)
    return (*(1000.0 * part for part in parts), float(len(path.waypoints) > 2))


def _ompl(case: Case) -> float:
    settings = PlannerSettings()
    begin = time.process_time()
    problem = Problem(
        space=case.space,
        validity=case.checker,
        start=case.start,
        goals=[case.goal],
        rng=np.random.default_rng(0),
        settings=settings,
        step=settings.step,
        deadline=begin + 60.0,
    )
    path: Any = solver("RRTConnect")(problem)
    return 1000.0 * (time.process_time() - begin) if path is not None else float("inf")


def _print(title: str, rows: list[tuple[float, ...]]) -> None:
    medians = [statistics.median(column) for column in zip(*rows, strict=True)]
    print(f"{title:28}" + "".join(f"{value:11.2f}" for value in medians))


if __name__ == "__main__":
    main()
