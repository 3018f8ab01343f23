"""The metric of Kümmerle et al."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.mapping.relative_pose_error import (
    absolute_error_m,
    align,
    read_relations,
    relation_errors,
)
from gazelle.mapping.se2 import compose

TRAJECTORY = np.array([(0, 0, 0), (1, 0, 0), (1, 1, np.pi / 2), (0, 1, np.pi)], dtype=float)


def test_a_trajectory_fulfils_its_own_relations_in_any_frame() -> None:
    moved = compose(np.array([3.0, -2.0, 0.7]), TRAJECTORY)
    errors = relation_errors(moved, [0, 1], [1, 2], [(1, 0, 0), (0, 1, np.pi / 2)])
    assert errors.translation_m.max() < 1e-12
    assert errors.rotation_rad.max() < 1e-12


def test_errors_are_those_of_the_relative_pose() -> None:
    errors = relation_errors(TRAJECTORY, [0], [1], [(1.3, 0.4, -0.1)])
    assert errors.translation_m[0] == pytest.approx(0.5)
    assert errors.rotation_rad[0] == pytest.approx(0.1)
    assert str(errors).startswith("1 relations: translation 0.500 ± 0.000 m, median 0.500 m; ")


def test_broken_lines_of_a_file_are_told_and_left_out(tmp_path: Path) -> None:
    path = tmp_path / "log.relations"
    path.write_text("# times, pose\n1 2 0.5 0.1 0 0 0 0.2\n1 2 3\n1 2 x 0 0 0 0 0\n")
    diagnostics = Diagnostics()
    relations = read_relations(path, diagnostics)
    assert relations.relative.tolist() == [[0.5, 0.1, 0.2]]
    found = diagnostics.by_code("mapping.bad-line")
    assert [item.span.line for item in found if item.span] == [3, 4]
    assert "eight numbers are expected" in found[0].message


def test_relations_are_aligned_by_time(tmp_path: Path) -> None:
    path = tmp_path / "log.relations"
    path.write_text("1.01 2.0 1 0 0 0 0 0\n1 9 1 0 0 0 0 0\n")
    first, second, relative = align(read_relations(path, Diagnostics()), [1.0, 2.0, 3.0])
    assert (first.tolist(), second.tolist(), len(relative)) == ([0], [1], 1)


def test_the_absolute_error_does_not_depend_on_the_frame() -> None:
    moved = compose(np.array([3.0, -2.0, 2.7]), TRAJECTORY)
    assert absolute_error_m(moved, TRAJECTORY) < 1e-12


def test_gmappings_log_has_its_known_errors(shared_dir: Path) -> None:
    data = np.load(shared_dir / "data" / "slam" / "intel.npz")
    relative = data["rel"][:, [2, 3, 7]]
    errors = relation_errors(data["ref"], data["ri"], data["rj"], relative)
    turn = np.degrees(errors.rotation_rad)
    assert errors.translation_m.mean() == pytest.approx(0.115, abs=1e-3)
    assert np.median(errors.translation_m) == pytest.approx(0.045, abs=1e-3)
    assert (turn.mean(), np.median(turn)) == pytest.approx((1.95, 0.58), abs=0.01)
