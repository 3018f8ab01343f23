"""SLAM in buildings whose walls are known, with other lidars and wheels than the Intel log's."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.mapping import buildings as b

from gazelle.mapping.relative_pose_error import absolute_error_m, alignment
from gazelle.mapping.se2 import transform_points
from gazelle.mapping.slam import Slam, load_graph, save_graph

BAD = b.Wheels(0.1, 0.15, 0.02, 0.01, 0.01, 10)
HOUSE = "a house, a short-sighted lidar"
CASES: dict[str, tuple[Callable[[], Any], float]] = {
    HOUSE: (lambda: b.log_of(b.house(0), b.LDS), 0.06),
    "a house, wheels that slip": (lambda: b.log_of(b.house(1), b.LDS, BAD, 1), 0.08),
    "a corridor longer than one sees": (lambda: b.log_of(b.corridor(20, 0), b.LDS), 0.4),
    "a corridor there and back": (lambda: b.log_of(b.corridor(60, 0), b.SICK, BAD, 0, 0.2), 0.5),
    "a hall with pillars": (lambda: b.log_of(b.hall(20, 15, 0), b.HOKUYO, BAD, 0, 0.25), 0.06),
    "a ring of corridors": (lambda: b.log_of(b.ring(40, 25, 0), b.SICK, BAD, 0, 0.25), 0.4),
}


@cache
def _log(name: str) -> Any:
    return CASES[name][0]()


@cache
def _mapped_once(name: str) -> Slam:
    """What tests only look at."""
    return b.mapped(_log(name))


@pytest.mark.parametrize("name", CASES)
def test_the_trajectory_is_the_robots(name: str) -> None:
    most_m, log = CASES[name][1], _log(name)
    odometry = np.array([pose for _, pose in log.records])
    found_m = absolute_error_m(_mapped_once(name).trajectory(), log.truth)
    assert found_m < most_m
    assert found_m < 0.5 * absolute_error_m(odometry, log.truth)


def test_walls_of_the_map_are_the_buildings() -> None:
    building = b.house(2)
    log = b.log_of(building, b.LDS)
    engine = b.mapped(log)
    grid = engine.grid()
    rows, columns = np.nonzero(grid.cells == 100)
    cells = np.stack(grid.cell_to_world(columns, rows), axis=-1)
    points = transform_points(alignment(engine.trajectory(), log.truth), cells)
    ends = building.walls.reshape(-1, 2, 2)
    along = ends[:, 1] - ends[:, 0]
    share = ((points[:, None] - ends[:, 0]) * along).sum(-1) / (along**2).sum(-1)
    nearest = ends[:, 0] + np.clip(share, 0, 1)[..., None] * along
    far = np.hypot(*np.moveaxis(points[:, None] - nearest, -1, 0)).min(axis=1)
    assert (far < 0.05).mean() > 0.95


def test_a_saved_graph_of_poses_goes_on_where_it_was(tmp_path: Path) -> None:
    log = _log(HOUSE)
    engine = Slam()
    for record in log.records[:200]:
        engine.add(*record)
    save_graph(engine, tmp_path / "house.posegraph")
    again = load_graph(tmp_path / "house.posegraph", engine.parameters)
    np.testing.assert_allclose(again.keyframes.poses, engine.keyframes.poses)
    np.testing.assert_array_equal(again.grid().cells, engine.grid().cells)
    again.resume(engine.pose)
    again.is_mapping = False
    for scan, odometry in log.records[200:260]:
        update = again.add(scan, odometry)
        engine.add(scan, odometry)
    assert update.is_matched
    assert np.hypot(*(again.pose - engine.pose)[:2]) < 0.1
    assert len(again.keyframes) < len(engine.keyframes)


def test_the_same_log_gives_the_same_map() -> None:
    first, second = _mapped_once(HOUSE), b.mapped(_log(HOUSE))
    np.testing.assert_array_equal(first.trajectory(), second.trajectory())
    np.testing.assert_array_equal(first.grid().cells, second.grid().cells)


def test_odometry_that_is_no_number_is_refused() -> None:
    log = _log(HOUSE)
    with pytest.raises(ValueError, match="not three finite numbers"):
        Slam().add(log.records[0][0], (0.0, float("nan"), 0.0))
