"""The page about launch is what its generator prints, and names nothing twice."""

from __future__ import annotations

from pathlib import Path

from gazelle.launch.ros2.documentation import reference_markdown

PAGE = Path(__file__).parents[3] / "docs" / "launch.md"


def test_the_page_is_generated() -> None:
    command = "python -m gazelle.launch.ros2.documentation > docs/launch.md"
    assert PAGE.read_text(encoding="utf-8") == reference_markdown(), f"run: {command}"


def test_every_row_says_what_it_is() -> None:
    rows = [line.split("|") for line in reference_markdown().splitlines() if line[:3] == "| `"]
    assert len(rows) > 140
    assert [row[1] for row in rows if not row[2].strip().endswith(".")] == []
