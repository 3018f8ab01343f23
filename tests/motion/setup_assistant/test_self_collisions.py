"""Pairs of links that need no collision check."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from tests.motion.setup_assistant.conftest import HERON, SEVEN, proposed
from tests.motion.setup_assistant.robots import chain, joint, link

from gazelle.diagnostics import Diagnostics
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.model import RobotModel
from gazelle.motion.scene import AllowedCollisions, PlanningScene
from gazelle.motion.setup_assistant import DisabledReason, self_collision_matrix
from gazelle.motion.setup_assistant.self_collisions import random_positions

Bare = Callable[[str], RobotModel]


def _reasons(robot: RobotModel, **changes: object) -> dict[tuple[str, str], DisabledReason | None]:
    matrix = self_collision_matrix(robot, **{"trials": 400, **changes})  # type: ignore[arg-type]
    return {(pair.link1, pair.link2): pair.reason for pair in matrix.pairs}


@pytest.mark.parametrize("file", [SEVEN, HERON], ids=lambda file: file.name.split(".")[0])
def test_no_pair_of_never_collides_in_fresh_configurations(file) -> None:
    robot = RobotModel.build(proposed(file)[1], diagnostics=Diagnostics())
    matrix = self_collision_matrix(robot, trials=3000)
    never = {
        frozenset((pair.link1, pair.link2))
        for pair in matrix.pairs
        if pair.reason is DisabledReason.NEVER
    }
    assert never
    others = {
        frozenset((pair.link1, pair.link2)): True
        for pair in matrix.pairs
        if pair.reason is not DisabledReason.NEVER
    }
    scene = PlanningScene.of(robot).with_allowed(AllowedCollisions(others))
    checker = CollisionChecker(scene)
    fresh = random_positions(robot, 300, np.random.default_rng(9))
    found = {str(contact) for row in fresh for contact in checker.contacts(row)}
    assert not found


def test_neighbours_are_adjacent_and_a_link_without_shape_joins_those_around_it(bare: Bare) -> None:
    urdf = link("a") + link("socket", "") + link("b") + link("c")
    urdf += joint("j1", "a", "socket") + joint("j2", "socket", "b") + joint("j3", "b", "c")
    reasons = _reasons(bare(urdf))
    assert reasons["a", "b"] is reasons["b", "c"] is DisabledReason.ADJACENT
    assert set(reasons) == {("a", "b"), ("a", "c"), ("b", "c")}


def test_what_overlaps_at_the_defaults_is_default_and_what_nearly_always_does_is_always(
    bare: Bare,
) -> None:
    urdf = chain("", "base", 4) + link("base") + link("box", at="0 0 0.4")
    urdf += joint("fixed", "base", "box", "fixed", at="0 0 0")
    assert _reasons(bare(urdf))["box", "link_2"] is DisabledReason.DEFAULT
    # At its default the slider is just outside of the wall, elsewhere always in it.
    slides = link("wall", "2 1 1", at="1 0 0") + link("between", at="0 3 0")
    slides += link("slider", "0.02 0.02 0.02", at="-0.03 0 0")
    slides += joint("held", "wall", "between", at="0 0 0", kind="fixed")
    slides += joint("slide", "between", "slider", "prismatic", "0 0 0", "1 0 0",
                    'lower="0" upper="1"')  # fmt: skip
    assert _reasons(bare(slides))["slider", "wall"] is DisabledReason.ALWAYS


def test_rigid_pairs_that_are_apart_never_meet_and_those_that_overlap_are_default(
    bare: Bare,
) -> None:
    urdf = link("base") + link("near", at="0 0 0.3") + link("far") + link("inside", at="0 0 0.31")
    urdf += joint("f1", "base", "near", "fixed", at="0 0 0") + joint("f2", "base", "far", "fixed")
    urdf += joint("f3", "far", "inside", "fixed", at="0 0 -0.2")
    reasons = _reasons(bare(urdf))
    assert reasons["inside", "near"] is DisabledReason.DEFAULT
    assert reasons["far", "near"] is DisabledReason.NEVER


def test_the_same_seed_gives_the_same_pairs_and_progress_goes_up_to_one() -> None:
    robot = RobotModel.build(proposed(SEVEN)[1], diagnostics=Diagnostics())
    told: list[float] = []
    first = self_collision_matrix(robot, trials=600, seed=4, progress=told.append)
    again = self_collision_matrix(robot, trials=600, seed=4)
    assert first == again
    assert told == sorted(told) and told[-1] == 1.0
    assert sum(first.count(reason) for reason in (None, *DisabledReason)) == len(first.pairs)


def test_what_progress_raises_ends_the_search() -> None:
    robot = RobotModel.build(proposed(SEVEN)[1], diagnostics=Diagnostics())

    def stop(_done: float) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        self_collision_matrix(robot, trials=600, progress=stop)


def test_numbers_out_of_range_are_refused(bare: Bare) -> None:
    with pytest.raises(ValueError, match="at least one trial is needed"):
        self_collision_matrix(bare(link("a")), trials=0)
    with pytest.raises(ValueError, match="a fraction above 0 and up to 1"):
        self_collision_matrix(bare(link("a")), always_fraction=1.5)


def test_without_never_only_the_quick_reasons_are_given() -> None:
    robot = RobotModel.build(proposed(SEVEN)[1], diagnostics=Diagnostics())
    matrix = self_collision_matrix(robot, include_never=False)
    assert matrix.count(DisabledReason.NEVER) == 0
    assert matrix.count(DisabledReason.ADJACENT) > 0
    assert replace(matrix.disabled()[0], reason="").link1 < matrix.disabled()[0].link2
