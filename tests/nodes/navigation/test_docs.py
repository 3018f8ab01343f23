"""The page of parameters is what its generator prints."""

from __future__ import annotations

from pathlib import Path

from gazelle.nodes.navigation.docs import page

ROOT = Path(__file__).parents[3]


def test_page_is_generated_from_the_tables() -> None:
    text = (ROOT / "docs" / "navigation.md").read_text(encoding="utf-8")
    command = "python -m gazelle.nodes.navigation.docs > docs/navigation.md"
    assert text == page(), f"run: {command}"


def test_every_row_says_what_it_means() -> None:
    for line in page().splitlines():
        if line.startswith("| `"):
            assert line.rstrip(" |").rpartition("|")[2].strip(), line
