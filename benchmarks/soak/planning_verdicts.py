"""Which random problems of arms have a solution: OMPL's verdicts, recorded once.

    pip install "gazelle-sim[ompl]"
    python benchmarks/soak/planning_verdicts.py [--count N] [--limit S] [ROBOT ...]

OMPL's RRTConnect has 30 s of CPU time for each problem, and what it finds must stand the check
every 0.005 rad. Starts, goals and verdicts go to ``tests/motion/planning_verdicts.json``, where
`tests/motion/test_verdicts.py` reads them in every test run. Prints how many of the solvable ones
Gazelle solves.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.motion.problems import REACHES_M, Case, random_case, robot_named

from gazelle.motion.planning import PlannerSettings, PlanningError, Search, first_fault, plan
from gazelle.motion.planning.ompl_planners import solver
from gazelle.motion.planning.problem import Problem

_FILE = Path(__file__).parents[2] / "tests" / "motion" / "planning_verdicts.json"


class _CpuProblem(Problem):
    """A problem whose deadline is one of CPU time, so that other programs do not matter."""

    def is_over(self) -> bool:
        return time.process_time() >= self.deadline


def main() -> None:
    """Record verdicts of each robot."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("robots", nargs="*", metavar="ROBOT", help=f"of {', '.join(REACHES_M)}")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--limit", type=float, default=30.0, help="CPU seconds per problem")
    options = parser.parse_args()
    for name in options.robots or list(REACHES_M):
        robot = robot_named(name)
        cases = [random_case(robot, name, number) for number in range(options.count)]
        verdicts = [_has_solution(case, options.limit) for case in cases]
        _record(name, cases, verdicts)
        solved = sum(
            _is_solved(case) for case, verdict in zip(cases, verdicts, strict=True) if verdict
        )
        print(f"{name}: {sum(verdicts)} of {len(cases)} have a solution, Gazelle finds {solved}")


def _has_solution(case: Case, limit_s: float) -> bool:
    space = case.space
    end = time.process_time() + limit_s
    for step in (0.05, 0.01, 0.005):
        problem = _CpuProblem(
            space=space,
            validity=case.checker,
            start=case.start,
            goals=[case.goal],
            rng=np.random.default_rng(case.number),
            settings=PlannerSettings(),
            step=step,
            deadline=end,
        )
        path = solver("RRTConnect")(problem)
        if path is None:
            return False
        if not first_fault(space, case.checker, np.array(path)):
            return True
    return False


def _is_solved(case: Case) -> bool:
    try:
        plan(
            case.space,
            case.checker,
            case.start,
            [case.goal],
            search=Search(seed=case.number, time_limit_s=60.0),
        )
    except PlanningError as error:
        print(f"  problem {case.number}: {error}")
        return False
    return True


def _record(name: str, cases: list[Case], verdicts: list[bool]) -> None:
    whole = json.loads(_FILE.read_text(encoding="utf-8")) if _FILE.exists() else {}
    whole[name] = [
        [case.number, case.start.tolist(), case.goal.tolist(), int(verdict)]
        for case, verdict in zip(cases, verdicts, strict=True)
    ]
    lines = [
        f'"{key}": [\n' + ",\n".join(json.dumps(row, separators=(",", ":")) for row in rows) + "\n]"
        for key, rows in sorted(whole.items())
    ]
    _FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
