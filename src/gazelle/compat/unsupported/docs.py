"""``docs/python_names.md``, printed by ``python -m gazelle.compat.unsupported.docs``."""

from __future__ import annotations

import sys

from gazelle.compat.unsupported.attributes import UNSUPPORTED_ATTRIBUTES
from gazelle.compat.unsupported.modules import UNSUPPORTED_MODULES

__all__ = ["unsupported_markdown"]

_HEAD = """# Python names of ROS that are not here

A user's package imports ROS's Python modules from Gazelle. These modules, attributes and keyword
arguments of the originals are not among them; who uses one reads the sentence at that place: an
`ImportError`, `AttributeError` or `TypeError` with `gazelle:` in it. `*` stands for any ending,
`(word)` for a keyword argument. Below a module that is refused, everything is.

| What | Why, and what to do |
|---|---|
"""


def unsupported_markdown() -> str:
    """Return the page: the names of each sentence in one row."""
    names: dict[str, list[str]] = {}
    for module, reason in UNSUPPORTED_MODULES:
        names.setdefault(reason, []).append(module)
    for part, reason in UNSUPPORTED_ATTRIBUTES:
        names.setdefault(reason, []).append(part)
    rows = sorted((sorted(found), reason) for reason, found in names.items())
    lines = [
        f"| {', '.join(f'`{name}`' for name in found)} | it {reason} |" for found, reason in rows
    ]
    return _HEAD + "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.stdout.write(unsupported_markdown())
