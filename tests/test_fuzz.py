"""Damaged files end in findings, never in a crash: the same ones every time.

`benchmarks/soak/fuzz.py` reads a million of them.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.fuzzing.kinds import KINDS, SCOUT
from tests.fuzzing.mutations import damaged
from tests.fuzzing.run import is_error, read_damaged, read_one

from gazelle.workspace import Workspace

COUNT = 35
# The machine may be busy and the first file of a kind imports what it needs.
PATIENCE_S = 30.0
# What is damaged there is left out or shown as something else, as the originals do.
LENIENT = {
    "cdr_grid", "cmake_lists", "material", "mcap", "mcap_lz4", "mcap_zstd", "model_config",
    "qt_form", "setup", "setup_cfg", "texture_jpeg", "texture_png", "texture_tga", "texture_tiff",
    "urdfdom",
}  # fmt: skip
CORPUS = Path(__file__).parent / "fuzz_corpus"


@pytest.mark.parametrize("name", KINDS)
def test_damaged_files_end_in_findings(name: str, tmp_path: Path) -> None:
    outcome = read_damaged(KINDS[name], range(COUNT), tmp_path, most_s=PATIENCE_S)
    assert not outcome.crashes
    assert outcome.refused > COUNT // 10 or name in LENIENT


@pytest.mark.parametrize("name", KINDS)
def test_undamaged_files_are_read(name: str, tmp_path: Path) -> None:
    workspace = Workspace.discover(extra=[SCOUT])
    found = read_one(KINDS[name], KINDS[name].good(), tmp_path, workspace)
    assert not [line for line in found if is_error(line) or line.startswith("crash")]


@pytest.mark.parametrize(
    "path", sorted(CORPUS.glob("*/*")), ids=lambda path: f"{path.parent.name}-{path.name}"
)
def test_files_that_once_crashed_end_in_findings(path: Path, tmp_path: Path) -> None:
    workspace = Workspace.discover(extra=[SCOUT])
    found = read_one(KINDS[path.parent.name], path.read_bytes(), tmp_path, workspace)
    assert any(map(is_error, found)), found
    assert not [line for line in found if line.startswith("crash")]


def test_damage_is_the_same_every_time() -> None:
    good = KINDS["urdf"].good()
    assert [damaged(good, number) for number in range(20)] == [
        damaged(good, number) for number in range(20)
    ]
