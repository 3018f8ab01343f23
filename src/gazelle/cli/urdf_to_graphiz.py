"""``urdf_to_graphiz``: the old, misspelt name of ``urdf_to_graphviz``."""

from __future__ import annotations

import sys

from gazelle.cli import urdf_to_graphviz

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Say which name to use, and do the same."""
    print(
        "WARNING: The executable named 'urdf_to_graphiz' is deprecated. "
        "Use 'urdf_to_graphviz' instead.",
        file=sys.stderr,
    )
    return urdf_to_graphviz.main(argv)
