"""The page's generated sources are what their generator writes."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.studio.displays.display import Display
from gazelle.studio.displays.registry import DISPLAYS
from gazelle.studio.typescript.sources import FILES, FOLDER

_FOLDER = Path(__file__).parents[3] / FOLDER


@pytest.mark.parametrize("name", FILES)
def test_generated_source_is_up_to_date(name: str) -> None:
    text = (_FOLDER / name).read_text(encoding="utf-8")
    assert text == FILES[name](), "run: python -m gazelle.studio.typescript"


def test_nothing_else_is_among_the_generated_sources() -> None:
    assert sorted(path.name for path in _FOLDER.iterdir()) == sorted(FILES)


@pytest.mark.parametrize("display", DISPLAYS.values(), ids=lambda display: display.name)
def test_what_draws_a_display_is_there(display: Display) -> None:
    module, _, constant = display.drawing.partition(":")
    source = (_FOLDER.parent / f"{module}.ts").read_text(encoding="utf-8")
    assert f"export const {constant}" in source
