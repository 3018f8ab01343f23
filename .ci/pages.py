#!/usr/bin/env python3
"""Writes everything in the repository that is generated from tables in the code.

    python .ci/pages.py [--check]

That is the generated pages and pictures of docs/, and the TypeScript of the page that Python
declares. With --check nothing is written: what is out of date is named, and the exit code is 1.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

__all__ = ["PAGES"]

_ROOT = Path(__file__).resolve().parents[1]
_TYPESCRIPT = ["-m", "gazelle.studio.typescript"]
_PICTURES = [str(_ROOT / ".ci" / "pictures.py")]

# The page and the module that prints it.
PAGES = {
    "builtin_nodes.md": "gazelle.node_specs.docs",
    "controllers.md": "gazelle.control.controllers",
    "cpp_headers.md": "gazelle.cpp.documentation",
    "diagnostics.md": "gazelle.diagnostics.documentation",
    "launch.md": "gazelle.launch.ros2.documentation",
    "navigation.md": "gazelle.nodes.navigation.docs",
    "nodes.md": "gazelle.nodes.docs",
    "plugins.md": "gazelle.simulator.plugins",
    "python_names.md": "gazelle.compat.unsupported.docs",
    "slam.md": "gazelle.nodes.slam.docs",
    "worlds.md": "gazelle.workspace.gazebo_models",
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
    docs = _ROOT / "docs"
    pages = {docs / name: _run(["-m", module]) for name, module in PAGES.items()}
    pictures = _written(_PICTURES, docs / "pictures")
    return pages | pictures | _written(_TYPESCRIPT, _ROOT / "studio" / "src" / "generated")


def _written(command: list[str], place: Path) -> dict[Path, bytes]:
    with tempfile.TemporaryDirectory() as folder:
        _run([*command, folder])
        return {place / path.name: path.read_bytes() for path in Path(folder).iterdir()}


def _run(command: list[str]) -> bytes:
    whole = [sys.executable, *command]
    return subprocess.run(whole, cwd=_ROOT, check=True, stdout=subprocess.PIPE).stdout


def _is_old(path: Path, text: bytes, *, check: bool) -> bool:
    is_old = not path.exists() or path.read_bytes() != text
    if is_old and not check:
        path.write_bytes(text)
    return is_old


if __name__ == "__main__":
    sys.exit(main())
