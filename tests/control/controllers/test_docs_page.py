"""The page of the controllers."""

from __future__ import annotations

from pathlib import Path

from gazelle.control.controllers.docs_page import tables_as_markdown
from gazelle.control.controllers.registry import all_tables

ROOT = Path(__file__).parents[3]


def test_page_of_controllers_is_generated_from_the_tables() -> None:
    page = (ROOT / "docs" / "controllers.md").read_text(encoding="utf-8")
    command = "python -m gazelle.control.controllers > docs/controllers.md"
    assert page == tables_as_markdown(all_tables()), f"run: {command}"
