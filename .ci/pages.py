#!/usr/bin/env python3
"""Writes everything in the repository that is generated from tables in the code.

    python .ci/pages.py [--check]

That is the generated pages of docs/ and the TypeScript of the page that Python declares. With
--check nothing is written: what is out of date is named, and the exit code is 1.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

__all__ = ["PAGES"]

_ROOT = Path(__file__).resolve().parents[1]
_TYPESCRIPT = _ROOT / "studio" / "src" / "generated"

# The page and the module that prints it.
PAGES = {
    "builtin_nodes.md": "gazelle.node_specs.page",
    "controllers.md": "gazelle.control.controllers",
    "diagnostics.md": "gazelle.diagnostics.docs",
    "launch.md": "gazelle.launch.ros2.reference",
    "navigation.md": "gazelle.nodes.navigation.page",
    "nodes.md": "gazelle.nodes.page",
    "plugins.md": "gazelle.simulator.plugins",
    "python_names.md": "gazelle.compat.refused_page",
    "slam.md": "gazelle.nodes.slam.page",
    "worlds.md": "gazelle.workspace.originals_page",
}


def main(arguments: list[str] | None = None) -> int:
    """Write, or check, all of them."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="write nothing, name what is old")
    check = parser.parse_args(arguments).check
    old = [path for path, text in _generated().items() if _is_old(path, text, check=check)]
    for path in old:
        print(f"{'out of date' if check else 'written'}: {path.relative_to(_ROOT)}")
    return int(check and bool(old))


def _generated() -> dict[Path, bytes]:
    pages = {_ROOT / "docs" / name: _printed(module) for name, module in PAGES.items()}
    with tempfile.TemporaryDirectory() as folder:
        _printed("gazelle.studio.typescript", folder)
        written = {_TYPESCRIPT / path.name: path.read_bytes() for path in Path(folder).iterdir()}
    return pages | written


def _printed(module: str, *arguments: str) -> bytes:
    command = [sys.executable, "-m", module, *arguments]
    return subprocess.run(command, cwd=_ROOT, check=True, stdout=subprocess.PIPE).stdout


def _is_old(path: Path, text: bytes, *, check: bool) -> bool:
    is_old = not path.exists() or path.read_bytes() != text
    if is_old and not check:
        path.write_bytes(text)
    return is_old


if __name__ == "__main__":
    sys.exit(main())
