#!/usr/bin/env python3
"""Builds the wheel and the sdist of a tag, the same bytes each time.

    python .ci/release.py v0.2.0 [--out DIR]

The tag's own tree is built, whatever lies in the folder. The version in the code has to be the
tag's, and CHANGELOG.md has to have its section with a date. Both files are built twice and
compared; their times are the tag's commit's. The last lines are names and SHA-256.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

__all__ = ["build", "problems"]

_ROOT = Path(__file__).resolve().parents[1]


def main(arguments: list[str] | None = None) -> int:
    """Check the tag, build and compare."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tag")
    parser.add_argument("--out", type=Path, default=_ROOT / "dist")
    options = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as folder:
        tree, again = Path(folder) / "tree", Path(folder) / "again"
        _git("worktree", "add", "--quiet", "--detach", str(tree), options.tag)
        try:
            if found := problems(tree, options.tag):
                print("\n".join(found), file=sys.stderr)
                return 1
            stamp_s = int(_git("log", "-1", "--format=%ct", options.tag))
            first, second = build(tree, options.out, stamp_s), build(tree, again, stamp_s)
        finally:
            _git("worktree", "remove", "--force", str(tree))
    for name, digest in first.items():
        print(f"{digest}  {name}")
    if first != second:
        print("built a second time, they differ", file=sys.stderr)
    return int(first != second)


def problems(tree: Path, tag: str) -> list[str]:
    """Return what keeps a tag from being released."""
    version = tag.removeprefix("v")
    found = []
    own = re.search(r'= "(.+)"', (tree / "src" / "gazelle" / "_version.py").read_text())
    if own is None or own[1] != version:
        found.append(f"src/gazelle/_version.py says {own and own[1]}, the tag {version}")
    changes = (tree / "CHANGELOG.md").read_text(encoding="utf-8")
    if not re.search(rf"^## \[{re.escape(version)}\] - \d{{4}}-\d\d-\d\d$", changes, re.MULTILINE):
        found.append(f"CHANGELOG.md has no line '## [{version}] - YYYY-MM-DD'")
    return found


def build(tree: Path, out: Path, stamp_s: int) -> dict[str, str]:
    """Build sdist and wheel of a tree; return their SHA-256 by name.

    Args:
        tree: the repository's files.
        out: where to; made when it is not there.
        stamp_s: the time that the files get, in seconds since 1970.
    """
    out.mkdir(parents=True, exist_ok=True)
    environment = os.environ | {"SOURCE_DATE_EPOCH": str(stamp_s)}
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "hatchling", "build", "-d", folder]
        subprocess.run(command, cwd=tree, env=environment, check=True, capture_output=True)
        made = sorted(Path(folder).iterdir())
        digests = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in made}
        for path in made:
            shutil.move(path, out / path.name)
    return digests


def _git(*arguments: str) -> str:
    command = ["git", "-C", str(_ROOT), *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


if __name__ == "__main__":
    sys.exit(main())
