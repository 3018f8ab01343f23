"""Import paths that ``docs/stability.md`` promises, and the names recorded for them."""

from __future__ import annotations

import importlib
import re
import warnings
from pathlib import Path

import pytest

from gazelle._version import __version__

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "stability.md"
NAMES = ROOT / "tests" / "stable_names.txt"
_IMPORT = re.compile(r"^\s*from (gazelle[\w.]*) import (.+)$", re.MULTILINE)


def _promised() -> list[str]:
    table = PAGE.read_text(encoding="utf-8").partition("## Import paths")[2]
    return re.findall(r"^\| `(gazelle[\w.]*)` \|", table, re.MULTILINE)


def _recorded() -> dict[str, set[str]]:
    """Names by module: a line each, ``module: name name``."""
    lines = NAMES.read_text(encoding="utf-8").splitlines()
    parted = (line.partition(": ") for line in lines)
    return {module: set(names.split()) for module, _, names in parted}


def test_every_promised_module_is_recorded() -> None:
    assert list(_recorded()) == _promised()


@pytest.mark.parametrize("module", _promised())
def test_promised_names_are_still_there_or_warn(module: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        found = importlib.import_module(module)
        gone = [name for name in sorted(_recorded()[module]) if not hasattr(found, name)]
    assert not gone, f"{module} promised {gone}: keep them for a release, by gazelle.deprecation"
    new = sorted(set(found.__all__) - _recorded()[module])
    assert not new, f"{module} offers more, which is a promise: add {new} to {NAMES.name}"


def test_the_documentation_imports_only_what_is_promised() -> None:
    recorded, wrong = _recorded(), []
    pages = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]
    for page in pages:
        for module, names in _IMPORT.findall(page.read_text(encoding="utf-8")):
            for name in re.findall(r"(\w+)(?: as \w+)?,?", names):
                if name not in recorded.get(module, set()):
                    wrong.append(f"{page.relative_to(ROOT)}: {module}.{name}")
    assert not wrong, "\n".join(wrong)


def test_no_old_name_outlives_the_release_it_goes_with() -> None:
    version = tuple(int(part) for part in __version__.split("."))
    late = []
    for path in sorted((ROOT / "src" / "gazelle").rglob("*.py")):
        for release in re.findall(r'gone_in="([\d.]+)"', path.read_text(encoding="utf-8")):
            if tuple(int(part) for part in release.split(".")) <= version:
                late.append(f"{path.relative_to(ROOT)}: {release}")
    assert not late, "\n".join(late)
