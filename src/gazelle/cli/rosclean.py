"""``rosclean check`` and ``rosclean purge``: the log files of nodes."""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import sys
from pathlib import Path

from gazelle.user_folders import ros_home, ros_log_folder

__all__ = ["main"]

_LABEL = "ROS node logs"
_BLOCK = 512
_STEP = 1024
_UNITS = "KMGT"
_MEGABYTE = 1 << 20


def main(argv: list[str]) -> int:
    """Run a subcommand.

    Returns:
        0; 1 when the logs were not removed; 2 for wrong usage.
    """
    parser = argparse.ArgumentParser(prog="rosclean")
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("check", help="Check usage of log files")
    purge = commands.add_parser("purge", help="Remove log files")
    purge.add_argument("-y", action="store_true", help="confirm all by typing yes")
    purge.add_argument(
        "--size", type=int, metavar="N", help="Maximum total size in MB to keep when deleting"
    )
    try:
        options = parser.parse_args(argv)
    except SystemExit as stop:
        return int(stop.code or 0)
    folder = ros_log_folder(os.environ)
    if not folder.is_dir():
        return 0
    if options.command == "check":
        print(f"{_human(_disk_usage(folder))} {_LABEL}")
        return 0
    return _purge(folder, yes=options.y, keep_mb=options.size)


def _purge(folder: Path, *, yes: bool, keep_mb: int | None) -> int:
    if folder.resolve() in {Path("/"), Path.home().resolve(), ros_home(os.environ).resolve()}:
        print(f"rosclean: '{folder}' is no folder of logs only; nothing removed", file=sys.stderr)
        return 1
    print(f"Purging {_LABEL}.")
    doomed = [folder] if keep_mb is None else _oldest_above(folder, keep_mb * _MEGABYTE)
    if not doomed:
        return 0
    if not yes:
        print("PLEASE BE CAREFUL TO VERIFY THE COMMAND BELOW!")
    lines = "\n".join(f"rm -rf {shlex.quote(str(path))}" for path in doomed)
    if not yes and not _asked(lines):
        return 0
    for path in doomed:
        _remove(path)
    return 0


def _asked(lines: str) -> bool:
    print(f"Okay to perform:\n\n{lines}\n(y/n)?", flush=True)
    for answer in sys.stdin:
        if answer.strip().lower() in {"y", "n"}:
            return answer.strip().lower() == "y"
        print("Please enter 'y' or 'n'", flush=True)
    return False


def _remove(path: Path) -> None:
    # A link goes, not what it leads to.
    if path.is_symlink() or not path.is_dir():
        path.unlink(missing_ok=True)
    else:
        shutil.rmtree(path)


def _oldest_above(folder: Path, keep: int) -> list[Path]:
    """Return the runs to remove, oldest first, until no more than `keep` bytes are left."""
    left = _disk_usage(folder)
    doomed = []
    for path in sorted(folder.iterdir(), key=lambda item: item.lstat().st_mtime):
        if left <= keep:
            break
        left -= _disk_usage(path)
        doomed.append(path)
    return doomed


def _disk_usage(path: Path) -> int:
    """Return the bytes on the disk, as ``du`` counts; links are not followed."""
    files = [path, *path.rglob("*")] if path.is_dir() and not path.is_symlink() else [path]
    return sum(item.lstat().st_blocks * _BLOCK for item in files)


def _human(count: int) -> str:
    """Return a size as ``du -h`` writes it: rounded up, one digit below ten."""
    value, unit = count / _STEP, 0
    while value >= _STEP and unit < len(_UNITS) - 1:
        value, unit = value / _STEP, unit + 1
    if 0 < value < 10 and unit:
        return f"{-(-value * 10 // 1) / 10:.1f}{_UNITS[unit]}"
    return f"{int(-(-value // 1))}{_UNITS[unit]}" if count else "0"
