"""Rows T8–T10: the published TurtleBot3 maps its world, finds itself and drives to goals."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.tutorial.turtlebot3_run import SHORT_ROUTE, scripted_run
from tests.tutorial.turtlebot3_session import Session

pytestmark = [pytest.mark.tutorial, pytest.mark.slow(60)]

_TOLERANCE_M, _TOLERANCE_RAD = 0.05, 0.17
# Localisation goes on after the end of a goal, and may see it a little differently then.
_LATER_M, _LATER_RAD = 0.02, 0.1
_LOCALISED_M = 0.1


def test_burger_maps_its_world_and_drives_to_goals(
    gazelle: Callable, workspaces_dir: Path, tmp_path: Path
) -> None:
    """20 goals, the whole map, more seeds and the waffle are in benchmarks/soak/navigation.py."""
    session = Session(gazelle, workspaces_dir / "turtlebot3_ws", "burger", HOME=str(tmp_path))
    session.hurry(3.0)
    report = scripted_run(session, tmp_path, model="burger", goals=2, seed=1, route=SHORT_ROUTE)
    for one in report.arrivals:
        assert one.text == "Goal reached.", one
        assert one.believed[0] <= _TOLERANCE_M + _LATER_M, one
        assert one.believed[1] <= _TOLERANCE_RAD + _LATER_RAD, one
        assert one.true[0] <= _TOLERANCE_M + _LOCALISED_M, one
    assert len(report.arrivals) == 2
    assert report.refusal.startswith(
        "Failed to find a valid plan. Even after executing recovery behaviors. Last reason: The"
        " goal (0.00, 0.00) is "
    )
    assert report.around_box == "Goal reached."
    assert report.updates_when_found is not None
    assert report.after_kidnap == "Goal reached."
    assert report.looks > 100
    assert not report.bumps
