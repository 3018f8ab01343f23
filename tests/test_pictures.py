"""Pictures of README and docs: each is made by a row, shows what exists, and is shown somewhere."""

from __future__ import annotations

import re
import shlex
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from tests.ci_scripts import FOLDER, ci_script

from gazelle.cli.commands import COMMANDS

_ROOT = Path(__file__).parents[1]
_PICTURES = _ROOT / "docs" / "pictures"
_LARGEST_BYTES = 4_000_000
_SHOWN = re.compile(r"[\w./-]*pictures/([\w-]+\.(?:webp|png|jpg))")


@pytest.fixture(scope="module")
def stages() -> Iterator[ModuleType]:
    sys.path.insert(0, str(FOLDER))
    yield ci_script("picture_stages")
    sys.path.remove(str(FOLDER))


def test_pictures_show_panels_that_the_page_has(stages: ModuleType) -> None:
    sources = (_ROOT / "studio" / "src").rglob("*.ts")
    kinds = {
        kind for path in sources for kind in re.findall(r"^ +kind: '([\w-]+)',$", _text(path), re.M)
    }
    shown = {kind for row in _rows(stages) for kind in (*getattr(row, "panels", ()),) if kind}
    assert "gazebo" in kinds
    assert shown <= kinds, f"no panel is called {sorted(shown - kinds)}"


def test_pictures_type_commands_and_launch_files_that_exist(stages: ModuleType) -> None:
    for stage in stages.STAGES:
        names = {path.name for path in (_ROOT / "examples" / stage.workspace).rglob("*")}
        for line in _lines(stages, stage):
            words = shlex.split(line)
            assert words[0] in COMMANDS or words[0].startswith("rqt"), line
            files = [word for word in words if re.search(r"\.launch(\.py)?$|\.rviz$", word)]
            assert {Path(file).name for file in files} <= names, line


def test_every_picture_is_made_by_a_row_and_every_row_has_its_pictures(stages: ModuleType) -> None:
    made = {name for row in _rows(stages) for name in stages.files_of(row)}
    there = {path.name for path in _PICTURES.glob("*.webp")}
    assert made == there, "run: python .ci/screenshots.py"


def test_every_picture_is_shown_on_a_page_and_every_shown_one_exists() -> None:
    pages = [_ROOT / "README.md", *(_ROOT / "docs").rglob("*.md")]
    shown = {name for page in pages for name in _SHOWN.findall(_text(page))}
    there = {path.name for path in _PICTURES.iterdir() if path.suffix != ".svg"}
    assert shown == there


def test_pictures_are_at_most_four_megabytes_together() -> None:
    every = [*_PICTURES.iterdir(), *(_ROOT / "src" / "gazelle" / "demo" / "pictures").iterdir()]
    assert len(every) > 40
    assert sum(path.stat().st_size for path in every) <= _LARGEST_BYTES


def _rows(stages: ModuleType) -> list[Any]:
    return [row for stage in stages.STAGES for row in stage.rows]


def _lines(stages: ModuleType, stage: Any) -> list[str]:
    typed = [line for line, _ in stage.commands]
    for row in stage.rows:
        typed += [line for line, _ in getattr(row, "typed", ())]
        if isinstance(row, stages.Film):
            typed.append(f"record {row.line}")
        elif isinstance(row, stages.Typed):
            typed.append(row.line)
        elif row.recorded:
            typed.append(f"record {row.recorded}")
    return typed


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8")
