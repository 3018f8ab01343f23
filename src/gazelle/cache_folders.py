"""Folders of what can be made anew, and whether they can be trusted and written.

What is kept there is machine code, scripts and data that later processes of the same user run or
take as true. So a folder counts only where it is the user's own and nobody else may write to it.
Where the one in the user's cache cannot be used, one below the system's temporary folder takes its
place, and where that cannot be either, nothing is kept: each is said once.
"""

from __future__ import annotations

import contextlib
import errno
import os
import stat
from pathlib import Path

from gazelle.announcements import announce
from gazelle.user_folders import cache_folder

__all__ = ["is_trusted", "is_usable", "own_cache", "own_folder", "tell_not_kept"]

_HOW = "name another folder by XDG_CACHE_HOME"
_MODE = 0o700
_OTHERS = stat.S_IWGRP | stat.S_IWOTH


def own_cache(part: str) -> Path | None:
    """Return the folder for a kind of things, made where it is missing; None where there is none.

    Args:
        part: what is kept, the folder's name: ``kernels``.
    """
    try:
        usual = cache_folder() / part
    except RuntimeError as error:
        usual, why = Path("~"), str(error)
    else:
        why = _why_not_usable(usual)
    if not why:
        return usual
    import tempfile

    spare = Path(tempfile.gettempdir()) / f"gazelle-{_user()}" / part
    # Its parent is in a folder of everybody's: who made it first may be somebody else.
    has_spare = not (_why_not_usable(spare.parent) or _why_not_usable(spare))
    place = f"kept in '{spare}' for now" if has_spare else "not kept, and made anew each time"
    _tell(usual, why, place)
    return spare if has_spare else None


def own_folder(folder: Path, variable: str) -> Path | None:
    """Return a folder that a variable names, made where it is missing; None, told, otherwise."""
    if why := _why_not_usable(folder, takes_over=False):
        announce(
            f"cannot use '{folder}', which {variable} names: {why}\n"
            f"  fix: {_fix(folder, f'let {variable} name another folder')}"
        )
        return None
    return folder


def is_usable(folder: Path) -> bool:
    """Make a folder of the user's cache; tell whether things can be kept there, and say why not."""
    why = _why_not_usable(folder)
    if why:
        _tell(folder, why, "not kept, and made anew each time")
    return not why


def is_trusted(folder: Path) -> bool:
    """Tell whether a folder is there, is this user's, and can be written by nobody else."""
    return folder.is_dir() and not _why_not_trusted(folder)


def _why_not_trusted(folder: Path) -> str:
    """Return why what lies in a folder is not to be taken for this user's; empty where it is."""
    if os.name != "posix":
        # The system's own rights keep others out of a user's folders there.
        return ""
    try:
        found = folder.stat()
    except OSError as error:
        return error.strerror or type(error).__name__
    if found.st_uid != os.geteuid():
        return f"it belongs to {_name_of(found.st_uid)}, who could have put code there"
    if found.st_mode & _OTHERS:
        return "others may write to it, who could put code there"
    return ""


def tell_not_kept(what: str, folder: Path, error: OSError, variable: str = "") -> None:
    """Say once that something could not be kept in a folder.

    Args:
        what: in the plural: ``compiled kernels``.
        folder: where.
        error: why not.
        variable: names the folder; that of all caches when empty.
    """
    how = f"let {variable} name another folder" if variable else _HOW
    why = error.strerror or type(error).__name__
    announce(
        f"cannot keep {what} in '{folder}': {why}; they are made anew each time\n"
        f"  fix: {_fix(folder, how, error.errno or 0)}",
        key=f"{what} {folder}",
    )


def _why_not_usable(folder: Path, *, takes_over: bool = True) -> str:
    """Make a folder; return why it cannot be used, empty where it can.

    Args:
        folder: where.
        takes_over: one that is the user's and that others may write to is emptied and theirs alone
            afterwards.
    """
    try:
        if not folder.is_dir():
            _make(folder)
    except OSError as error:
        return error.strerror or type(error).__name__
    if takes_over and _is_open(folder):
        try:
            _take_over(folder)
        except OSError as error:
            return error.strerror or type(error).__name__
    if why := _why_not_trusted(folder):
        return why
    return "" if os.access(folder, os.W_OK | os.X_OK) else "it cannot be written"


def _tell(folder: Path, why: str, place: str) -> None:
    # One trouble with all that is kept is said of the first folder.
    announce(
        f"cannot use '{folder}': {why}; what belongs there is {place}\n  fix: {_fix(folder)}",
        key=f"{folder.parent} {why}",
    )


def _is_open(folder: Path) -> bool:
    if os.name != "posix":
        return False
    found = folder.stat()
    return found.st_uid == os.geteuid() and bool(found.st_mode & _OTHERS)


def _take_over(folder: Path) -> None:
    import shutil

    folder.chmod(_MODE)
    for item in folder.iterdir():
        if item.is_dir() and not item.is_symlink():
            shutil.rmtree(item)
        else:
            item.unlink()
    announce(f"others could write to '{folder}': it is emptied, and only this user's from now on")


def _make(folder: Path) -> None:
    folder.parent.mkdir(parents=True, exist_ok=True)
    with contextlib.suppress(FileExistsError):
        # Not what the user's mask leaves: many let a group write.
        folder.mkdir(mode=_MODE)


def _fix(folder: Path, how: str = _HOW, number: int = 0) -> str:
    if number in (errno.ENOSPC, errno.EDQUOT):
        return f"make some room there, or {how}"
    if os.name == "posix" and folder.is_dir() and _why_not_trusted(folder):
        found = folder.stat()
        if found.st_uid == os.geteuid():
            return f"chmod go-w '{folder}', or {how}"
        return f"{how}; each user has their own"
    return f"{how} (ls -ld shows whose it is)"


def _name_of(uid: int) -> str:
    import pwd

    try:
        return f"user '{pwd.getpwuid(uid).pw_name}'"
    except KeyError:
        return f"user {uid}"


def _user() -> str:
    return str(os.getuid()) if os.name == "posix" else os.environ.get("USERNAME", "user")
