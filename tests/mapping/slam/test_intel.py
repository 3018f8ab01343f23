"""The log of the Intel Research Lab, against gmapping's published one (see the data's README)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.mapping.logs import LogRecord, read_log
from gazelle.mapping.relations import absolute_error_m, relation_errors
from gazelle.mapping.slam import slam

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
