"""``catkin clean``: removing the build, devel and install spaces."""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path

from gazelle.cli.catkin.profile import load_profile
from gazelle.workspace.building.packages import BuildError

__all__ = ["run"]


def run(words: list[str]) -> int:
    """Ask, unless told not to, and remove the spaces."""
    parser = argparse.ArgumentParser(prog="catkin clean")
    parser.add_argument("-w", "--workspace", type=Path, help="the workspace")
    parser.add_argument("-y", "--yes", action="store_true", help="do not ask")
    parser.add_argument("-n", "--dry-run", action="store_true", help="say what would be removed")
    options = parser.parse_args(words[1:])
    profile = load_profile(options.workspace or Path.cwd())
    spaces = profile.spaces
    there = [path for path in (spaces.build, spaces.devel, spaces.install) if path.is_dir()]
    for path in there:
        # A space such as '.' or one that is the source space would take the sources along.
        is_inside = profile.root in path.resolve().parents
        if not is_inside or path in (spaces.source, *spaces.source.parents):
            raise BuildError(
                f"'{path}' is not a folder of the workspace apart from its sources; it is not "
                "removed"
            )
        print(f"[clean] Removing {path}")
    if options.dry_run or not there:
        print("[clean] Nothing was removed.")
        return 0
    if not options.yes and not _agreed():
        print("[clean] Not removing the spaces.")
        return 1
    for path in there:
        shutil.rmtree(path)
    return 0


def _agreed() -> bool:
    print("[clean] Are you sure you want to remove these folders? [y/N]: ", end="", flush=True)
    return sys.stdin.readline().strip().lower() in {"y", "yes"}
