"""axe-core in a page: what its rules of WCAG 2.1, levels A and AA, find wrong."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import pytest

__all__ = ["check_page", "violations"]

_FILE = Path(__file__).parents[2] / "studio" / "node_modules" / "axe-core" / "axe.min.js"
_TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"]
_RUN = """async (tags) => {
    const found = await axe.run(document, {runOnly: tags, resultTypes: ['violations']});
    return found.violations.flatMap((rule) => rule.nodes.map((node) =>
        `${rule.id}: ${node.target} ${node.failureSummary}`));
}"""


@cache
def _source() -> str:
    return _FILE.read_text(encoding="utf-8")


def violations(page: Any) -> list[str]:
    """Return what is wrong in a page as it is now, a line each."""
    if not _FILE.is_file():
        pytest.skip("axe-core is not installed (npm ci in studio/)")
    if not page.evaluate("() => 'axe' in window"):
        # As the browser's own tools do: the page's policy lets no script in.
        page.evaluate(_source())
    return list(page.evaluate(_RUN, _TAGS))


def check_page(page: Any, what: str) -> None:
    """Fail where something is wrong in a page as it is now."""
    wrong = violations(page)
    assert not wrong, "\n".join([f"{what}:", *wrong])
