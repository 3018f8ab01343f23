"""The tree of errors that is printed in `gazelle.errors`."""

from __future__ import annotations

import re
from pathlib import Path

import gazelle.errors

SOURCE = Path(gazelle.errors.__file__).parent
_CLASS = re.compile(r"^class (\w+)\((\w+)[^)]*\):", re.MULTILINE)


def _tree(base: str, parents: dict[str, str], depth: int = 1) -> list[str]:
    below = sorted(name for name, parent in parents.items() if parent == base)
    public = [name for name in below if not name.startswith("_")]
    lines = [line for name in public for line in _tree(name, parents, depth + 1)]
    return ["    " * depth + base, *lines]


def test_the_printed_tree_has_every_error_that_is_raised_on_purpose() -> None:
    drop_ins = SOURCE / "compat" / "modules"
    texts = (p.read_text("utf-8") for p in SOURCE.rglob("*.py") if drop_ins not in p.parents)
    parents = dict(pair for text in texts for pair in _CLASS.findall(text))
    printed = "\n".join(_tree("GazelleError", parents))
    assert printed in (gazelle.errors.__doc__ or ""), printed
