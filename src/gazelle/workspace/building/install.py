"""Carrying a plan out: copying, linking and writing below a prefix, and removing what is gone."""

from __future__ import annotations

import os
import shutil
import stat
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.workspace.building.plan import Item, Layout

__all__ = ["Installed", "install", "remove_recorded"]

_EXECUTABLE = stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH


@dataclass(slots=True)
class Installed:
    """What an installation did, with the words CMake has for it.

    Attributes:
        lines: ``-- Installing: …``, ``-- Up-to-date: …`` and ``-- Removing: …``.
    """

    lines: list[str] = field(default_factory=list)

    def say(self, what: str, path: Path) -> None:
        """Add a line."""
        self.lines.append(f"-- {what}: {path}")


def install(items: Iterable[Item], layout: Layout, record: Path) -> Installed:
    """Install items, after removing what an earlier build installed and this one does not.

    Args:
        items: their targets lie below the prefix.
        layout: prefix, and whether to link.
        record: file that lists what was installed, for the next build.

    Raises:
        OSError: something cannot be written.
    """
    done = Installed()
    wanted = {str(layout.prefix / item.target): item for item in items}
    remove_recorded(record, layout.prefix, done, keep=frozenset(wanted))
    record.parent.mkdir(parents=True, exist_ok=True)
    # Written first: what a build that breaks off has installed is known to the next one.
    record.write_text("".join(f"{path}\n" for path in sorted(wanted)), encoding="utf-8")
    for path, item in sorted(wanted.items()):
        target = Path(path)
        if any(str(folder) in wanted for folder in target.parents):
            done.say("Skipping (its folder is linked)", target)
            continue
        _make_folder(target.parent, layout.prefix)
        changed = _place(item, target, symlinks=layout.symlinks)
        done.say("Installing" if changed else "Up-to-date", target)
    return done


def remove_recorded(
    record: Path, prefix: Path, done: Installed, *, keep: frozenset[str] = frozenset()
) -> None:
    """Remove what a record lists below a prefix, and the folders that get empty by it."""
    try:
        paths = record.read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError):
        return
    for text in paths:
        path = Path(text)
        if text in keep or prefix not in path.parents or ".." in path.parts:
            continue
        # Behind a linked folder lie the user's sources.
        if any(part.is_symlink() for part in path.parents if prefix in part.parents):
            continue
        if path.is_symlink() or path.is_file():
            path.unlink()
            done.say("Removing", path)
        _remove_empty(path.parent, prefix)


def _remove_empty(folder: Path, prefix: Path) -> None:
    while folder != prefix and prefix in folder.parents:
        try:
            folder.rmdir()
        except OSError:  # not empty, or gone already
            return
        folder = folder.parent


def _make_folder(folder: Path, prefix: Path) -> None:
    """Make a folder; links and files in its way are ours, of a build with other options."""
    for part in reversed([folder, *folder.parents]):
        if prefix in part.parents and (part.is_symlink() or part.is_file()):
            part.unlink()
    folder.mkdir(parents=True, exist_ok=True)


def _place(item: Item, target: Path, *, symlinks: bool) -> bool:
    if item.source is None:
        return _write(item.text, target, is_program=item.is_program)
    if symlinks:
        return _link(item.source.resolve(), target)
    return _copy(item.source, target, is_program=item.is_program)


def _write(text: str, target: Path, *, is_program: bool) -> bool:
    if target.is_symlink():
        target.unlink()
    same = target.is_file() and target.read_text(encoding="utf-8", errors="replace") == text
    if not same:
        target.write_text(text, encoding="utf-8", newline="\n")
    _set_bit(target, is_program)
    return not same


def _link(source: Path, target: Path) -> bool:
    if target.is_symlink() and Path(os.readlink(target)) == source:  # noqa: PTH115
        return False
    _clear(target)
    target.symlink_to(source, target_is_directory=source.is_dir())
    return True


def _copy(source: Path, target: Path, *, is_program: bool) -> bool:
    if not target.is_symlink() and target.is_file() and _same(source, target):
        _set_bit(target, is_program)
        return False
    _clear(target)
    shutil.copy2(source, target)
    target.chmod(target.stat().st_mode | stat.S_IWUSR)
    _set_bit(target, is_program)
    return True


def _same(source: Path, target: Path) -> bool:
    one, other = source.stat(), target.stat()
    return one.st_size == other.st_size and one.st_mtime_ns == other.st_mtime_ns


def _set_bit(target: Path, is_program: bool) -> None:
    mode = target.stat().st_mode
    wanted = mode | _EXECUTABLE if is_program else mode & ~_EXECUTABLE
    if mode != wanted:
        target.chmod(wanted)


def _clear(target: Path) -> None:
    """Make room: a link or file is replaced; a folder only when nothing but folders is in it."""
    if target.is_symlink() or target.is_file():
        target.unlink()
    elif target.is_dir():
        for root, folders, _ in os.walk(target, topdown=False):
            for name in folders:
                Path(root, name).rmdir()
        target.rmdir()
