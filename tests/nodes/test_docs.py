"""The page of nodes' parameters is what its generator prints."""

from __future__ import annotations

from pathlib import Path

from gazelle.nodes.docs import page

ROOT = Path(__file__).parents[2]


def test_page_is_generated_from_the_tables() -> None:
    text = (ROOT / "docs" / "nodes.md").read_text(encoding="utf-8")
    assert text == page(), "run: python -m gazelle.nodes.docs > docs/nodes.md"


def test_every_row_says_what_it_means() -> None:
    for line in page().splitlines():
        if line.startswith("| `"):
            assert line.rstrip(" |").rpartition("|")[2].strip(), line
