"""The log of the Intel Research Lab, against gmapping's published one (see the data's README)."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.sets import few
from tests.shared_files import skip_module_without_shared

from gazelle.diagnostics import Diagnostics
from gazelle.mapping.logs import LogRecord, read_log
from gazelle.mapping.relative_pose_error import absolute_error_m, relation_errors
from gazelle.mapping.se2 import between, compose
from gazelle.mapping.slam import Slam, SlamParameters, slam

skip_module_without_shared()

# Errors of a map that is no longer one: prototypes without robust loops were metres off.
BROKEN_M = 0.5


@pytest.fixture(scope="module")
def folder(shared_dir: Path) -> Path:
    return shared_dir / "data" / "slam"


@pytest.fixture(scope="module")
def records(folder: Path) -> list[LogRecord]:
    return list(read_log(folder / "intel.npz", Diagnostics()))


@pytest.mark.reference
def test_relations_are_better_than_gmappings_in_mean_and_median(
    folder: Path, records: list[LogRecord]
) -> None:
    data = np.load(folder / "intel.npz")
    result = slam(records)
    pairs = data["ri"], data["rj"], data["rel"][:, [2, 3, 7]]
    own = relation_errors(result.trajectory, *pairs)
    gmapping = relation_errors(data["ref"], *pairs)
    for statistic in (np.mean, np.median):
        assert statistic(own.translation_m) < statistic(gmapping.translation_m)
        assert statistic(own.rotation_rad) < statistic(gmapping.rotation_rad)
    assert absolute_error_m(result.trajectory, data["ref"]) < BROKEN_M
    assert result.loops > 50


@pytest.mark.reference
@pytest.mark.parametrize("seed", range(few(1, 3)))
def test_disturbed_logs_and_other_parameters_do_not_break_the_map(
    folder: Path, records: list[LogRecord], seed: int
) -> None:
    """The full set, 20 of each, is benchmarks/soak/slam_robustness.py."""
    rng = np.random.default_rng(seed)
    odometry = np.array([record.odometry for record in records])
    steps = between(odometry[:-1], odometry[1:]) * (1 + rng.normal(0, 0.05, (len(records) - 1, 3)))
    steps += rng.normal(0, 1, steps.shape) * (0.02, 0.02, np.radians(1))
    names = ("sigma_m", "window_m", "window_rad", "odometry_m_per_m", "odometry_rad_per_rad",
             "keyframe_m", "least_loop", "max_range_m", "cell_m")  # fmt: skip
    told = SlamParameters(global_refinement=False)
    scaled = {name: getattr(told, name) * float(rng.uniform(0.8, 1.25)) for name in names}
    engine, pose = Slam(replace(told, **scaled)), np.zeros(3)
    for k, record in enumerate(records):
        pose = compose(pose, steps[k - 1]) if k else pose
        engine.add(record.scan, pose)
    engine.finish()
    reference = np.load(folder / "intel.npz")["ref"]
    assert absolute_error_m(engine.trajectory(), reference) < BROKEN_M
