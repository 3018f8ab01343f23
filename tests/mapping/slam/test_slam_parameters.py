"""Numbers of the algorithms stand in records, and what is given in them counts."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from tests.mapping import buildings as b

import gazelle.mapping
from gazelle.mapping.slam import SlamParameters
from gazelle.mapping.slam.keyframes import keyframe_of
from gazelle.mapping.slam.slam_parameters import OccupancySettings, SlamSettings

ROOT = Path(gazelle.mapping.__file__).parent
# Numbers of a module's own that are no tuning: of data structures, of the room that only warms up.
OTHER = {
    "scan_matching/branch_and_bound_kernels.py": {
        "LEAF",
        "_SIDE",
        "_FULL",
        "_MAX",
        "_PART",
        "_FEW",
        "_MAX_DEPTH",
    },
    "scan_matching/branch_and_bound.py": {"_MAX_DEPTH"},
    "pose_graph/constraints.py": {"DOUBTFUL", "UNKNOWN", "_MIN_SIGMA", "_FAINT"},
    "slam/occupancy_counts.py": {"_OCCUPIED"},
    "slam/kernel_warm_up.py": {"_OFF_M"},
}


def _numbers(file: Path) -> set[str]:
    """Return the names of a module that are set to a number or made of some."""
    found = set()
    for line in ast.parse(file.read_text(encoding="utf-8")).body:
        if isinstance(line, ast.Assign) and isinstance(line.targets[0], ast.Name):
            parts = [one.value for one in ast.walk(line.value) if isinstance(one, ast.Constant)]
            if any(isinstance(one, int | float) and one is not True for one in parts):
                found.add(line.targets[0].id)
    return found


def test_algorithms_have_no_numbers_besides_their_settings() -> None:
    for folder in ("loop_detection", "scan_matching", "pose_graph", "slam"):
        for file in sorted((ROOT / folder).glob("*.py")):
            name = file.relative_to(ROOT).as_posix()
            assert _numbers(file) <= OTHER.get(name, set()), name


def _records(record: Any) -> Iterator[Any]:
    for one in fields(record):
        value = getattr(record, one.name)
        if is_dataclass(value):
            yield from _records(value)
    yield record


def test_every_setting_is_explained() -> None:
    for record in (*_records(SlamSettings()), OccupancySettings()):
        text = str(type(record).__doc__)
        for one in fields(record):
            assert re.search(rf"\b{one.name}\b[^\n]*[:,]", text), (type(record).__name__, one.name)


def test_settings_that_are_given_count() -> None:
    log = b.log_of(b.house(0), b.LDS)
    usual = SlamParameters()
    few = replace(usual.settings.keyframes, most_points=30)
    given = replace(usual, settings=replace(usual.settings, keyframes=few))
    scan = log.records[0][0]
    assert len(keyframe_of(scan, usual, 0.0).points_m) > 30
    assert len(keyframe_of(scan, given, 0.0).points_m) == 30
    still = replace(usual.settings.engine, global_refinements=0, last_iterations=1)
    other = replace(usual, settings=replace(usual.settings, engine=still))
    records = log.records[:200]
    ways = [b.mapped(replace(log, records=records), p).trajectory() for p in (usual, other)]
    assert not np.array_equal(*ways)
