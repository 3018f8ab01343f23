"""The compiled loop of RRT-Connect against the one that asks for each motion."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import pytest
from tests.motion.problems import random_case

from gazelle.motion.collision import CollisionChecker
from gazelle.motion.joint_space import FloatArray, SweptValidity, Validity
from gazelle.motion.model import RobotModel
from gazelle.motion.planning import FINE_STEP, Search, plan
from gazelle.motion.planning.path_validation import ends_of
from gazelle.motion.planning.problem import PlannerSettings, Problem
from gazelle.motion.planning.rrt_connect import rrt_connect
from gazelle.motion.planning.rrt_connect_kernels import DOUBTFUL
from gazelle.motion.planning.search_tree import TreeArrays


class _Asked:
    """What a checker says, without what kernels need; counts its questions."""

    def __init__(self, checker: CollisionChecker) -> None:
        self._checker = checker
        self.asked: list[tuple[tuple[bytes, bytes], float]] = []

    @property
    def motions(self) -> int:
        return len(self.asked)

    def is_valid(self, q: FloatArray) -> bool:
        return self._checker.is_valid(q)

    def motion_is_valid(self, q0: FloatArray, q1: FloatArray, step: float) -> bool:
        self.asked.append((ends_of(q0, q1), step))
        return self._checker.motion_is_valid(q0, q1, step)

    def why(self, q: FloatArray) -> str:
        return self._checker.why(q)


class _Swept(_Asked):
    """The same, with what kernels need."""

    def swept_motions(self) -> Any:
        return self._checker.swept_motions()


def _searched(case: Any, validity: Validity) -> list[FloatArray] | None:
    settings = PlannerSettings()
    return rrt_connect(
        Problem(
            space=case.space,
            validity=validity,
            start=case.start,
            goals=[case.goal],
            rng=np.random.default_rng(3),
            settings=settings,
            step=settings.step,
            deadline=time.perf_counter() + 1e6,
        )
    )


@pytest.mark.parametrize("number", [7, 9, 15])
@pytest.mark.parametrize("arm", ["ur_like", "seven"])
def test_compiled_search_is_the_same_search(
    arm: str, number: int, request: pytest.FixtureRequest
) -> None:
    case = random_case(request.getfixturevalue(arm), arm, number)
    asked, swept = _Asked(case.checker), _Swept(case.checker)
    expected, found = _searched(case, asked), _searched(case, swept)
    assert expected is not None and found is not None
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)
    assert isinstance(swept, SweptValidity) and not isinstance(asked, SweptValidity)
    # The straight way is asked for, all else is the kernel's.
    assert swept.motions == 1 and asked.motions > 1


def test_what_the_kernel_cannot_tell_is_asked_for(
    ur_like: RobotModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = random_case(ur_like, "ur_like", 7)

    def in_doubt(near: TreeArrays, far: TreeArrays, *_: Any) -> tuple[Any, ...]:
        return DOUBTFUL, 0, -1, -1, near, far

    monkeypatch.setattr("gazelle.motion.planning.rrt_connect.connect_trees", in_doubt)
    asked, swept = _Asked(case.checker), _Swept(case.checker)
    expected, found = _searched(case, asked), _searched(case, swept)
    assert expected is not None and found is not None
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)
    assert swept.motions == asked.motions > 1


@pytest.mark.parametrize("step", [0.0, -1.0, np.nan])
def test_steps_of_no_length_are_refused(step: float, ur_like: RobotModel) -> None:
    """A kernel would make room for a negative number of pieces."""
    with pytest.raises(ValueError, match="checks are more than 0 apart"):
        PlannerSettings(step=step)
    case = random_case(ur_like, "ur_like", 7)
    with pytest.raises(ValueError, match="not more than 0"):
        case.checker.motion_is_valid(case.start, case.goal, step)


def test_a_range_below_zero_is_refused() -> None:
    with pytest.raises(ValueError, match="range is -1: the longest motion is 0 or more"):
        PlannerSettings(range=-1.0)


def test_the_last_check_does_not_repeat_what_shortcuts_were_checked_for(
    ur_like: RobotModel,
) -> None:
    case = random_case(ur_like, "ur_like", 7)
    swept = _Swept(case.checker)
    path = plan(case.space, swept, case.start, [case.goal], search=Search(time_limit_s=1e6))
    assert len(path.waypoints) > 2
    fine = [ends for ends, step in swept.asked if step <= FINE_STEP]
    assert fine and len(set(fine)) == len(fine)
