"""The page's generated sources are what their generator writes."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.studio.displays.registry import DISPLAYS
from gazelle.studio.typescript.files import FILES, FOLDER

_FOLDER = Path(__file__).parents[3] / FOLDER


@pytest.mark.parametrize("name", FILES)
def test_generated_source_is_up_to_date(name: str) -> None:
    text = (_FOLDER / name).read_text(encoding="utf-8")
    assert text == FILES[name](), "run: python -m gazelle.studio.typescript"


def test_nothing_else_is_among_the_generated_sources() -> None:
    assert sorted(path.name for path in _FOLDER.iterdir()) == sorted(FILES)


def test_every_display_has_one_drawing() -> None:
    registry = (_FOLDER.parent / "displays" / "registry.ts").read_text(encoding="utf-8")
    table = registry.partition("const DRAWINGS")[2].partition("{")[2].partition("};")[0]
    drawn = [line.strip().partition(":")[0] for line in table.splitlines() if line.strip()]
    assert drawn == sorted(DISPLAYS)
