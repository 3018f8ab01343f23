"""A pip package of somebody else's: a real distribution on the path, for entry points."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from textwrap import dedent

from gazelle.extensions import load_extensions

__all__ = ["code_of_page", "installed"]

_PAGE = Path(__file__).parents[1] / "docs" / "howto" / "extending.md"


@contextmanager
def installed(
    folder: Path, module: str, source: str, entry_points: Mapping[str, Mapping[str, str]]
) -> Iterator[Path]:
    """Install a package of one module; afterwards nobody knows it any more.

    Args:
        folder: an empty one.
        module: name of the module, and of the package.
        source: its text.
        entry_points: ``module:attribute`` by name by group.
    """
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{module}.py").write_text(dedent(source), encoding="utf-8")
    info = folder / f"{module}-1.2.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {module}\nVersion: 1.2\n")
    groups = (
        "\n".join((f"[{group}]", *(f"{name} = {value}" for name, value in points.items())))
        for group, points in entry_points.items()
    )
    (info / "entry_points.txt").write_text("\n\n".join(groups) + "\n", encoding="utf-8")
    sys.path.insert(0, str(folder))
    importlib.invalidate_caches()
    load_extensions.cache_clear()
    try:
        yield folder
    finally:
        sys.path.remove(str(folder))
        sys.modules.pop(module, None)
        importlib.invalidate_caches()
        load_extensions.cache_clear()


def code_of_page(heading: str) -> str:
    """Return the Python below a heading of the page that tells how to extend Gazelle."""
    _, _, section = _PAGE.read_text(encoding="utf-8").partition(f"\n## {heading}\n")
    return section.partition("```python\n")[2].partition("```")[0]
