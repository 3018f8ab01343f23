"""A TurtleBot3 that drives in its world, in the simulator: its map against the world's geometry."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.shared_files import skip_module_without_shared

skip_module_without_shared()

ROOT = Path(__file__).parents[3]
# Around the two pillars nearest to the start, back to it.
TOUR = [(-1.65, -0.55), (-0.55, -0.55), (-0.55, 0.55), (-1.65, 0.55), (-1.9, -0.5)]


def _soak() -> Any:
    """The whole tour with more of it."""
    path = ROOT / "benchmarks" / "soak" / "slam_turtlebot3.py"
    spec = importlib.util.spec_from_file_location("slam_turtlebot3", path)
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules["slam_turtlebot3"] = module
    spec.loader.exec_module(module)
    return module


@pytest.mark.tutorial
@pytest.mark.reference
@pytest.mark.parametrize("model", ["burger", "waffle"])
def test_the_map_is_the_worlds_and_the_trajectory_the_robots(
    workspaces_dir: Path, model: str
) -> None:
    soak = _soak()
    drive = soak.driven(workspaces_dir / "turtlebot3_ws", model, np.array(TOUR))
    drive = soak.slipping(drive, 0.1)
    result = soak.mapped(drive)
    found = soak.quality(drive, result)
    assert len(drive.records) > 100
    assert (result.grid.cells == 100).sum() > 300
    assert found.walls > 0.97
    assert found.most_m < 0.05
    assert found.most_deg < 1.0
