"""The outcome of looking for a file, and the look-up that forgives upper and lower case."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from gazelle.diagnostics import nearest_names
from gazelle.documents.files import exists, is_folder

__all__ = ["Resolved", "locate", "nearest_below", "nearest_packages"]

# Of a package that is looked through for a file of some name.
_MAX_FOLDERS = 300
# Endings that half of all packages share say nothing about which one was meant.
_COMMON_ENDINGS = (
    "_bringup",
    "_control",
    "_description",
    "_gazebo",
    "_msgs",
    "_navigation",
    "_simulation",
    "_support",
)


@dataclass(frozen=True, slots=True)
class Resolved:
    """Where a URI leads.

    Attributes:
        path: the existing file or folder; None when there is none.
        tried: every place looked at, in order.
        nearest: existing names most like the missing one, best first.
        note: what to tell the user although it was found (case differs …) or why it was not
            (the package is unknown …); empty when there is nothing to say.
        is_off_path: it was found near the file that names it, in a folder that no search path
            names; Gazebo would need one.
        is_stand_in: another model of this name is used in place of the one that was meant.
        right: the URI as it should be written where the spelling differs; else empty.
    """

    path: Path | None
    tried: tuple[str, ...] = ()
    nearest: tuple[str, ...] = ()
    note: str = ""
    is_off_path: bool = False
    is_stand_in: bool = False
    right: str = ""

    def explain(self, uri: str) -> str:
        """Return a message for a URI that leads nowhere: reason, nearest names, places."""
        text = f"'{uri}' not found"
        if self.note:
            text += f": {self.note}"
        if self.nearest:
            text += "; did you mean " + " or ".join(f"'{name}'" for name in self.nearest) + "?"
        if self.tried:
            text += "\n  looked in:\n" + "\n".join(f"    {path}" for path in self.tried)
        return text


def locate(base: Path, relative: str) -> tuple[Path | None, str]:
    """Return an existing path below `base` and a note; (None, "") when there is none.

    A source package's folder stands for its share folder: what installing puts elsewhere is found.
    When the exact name does not exist, one that differs only in upper and lower case is taken
    and the note says so: such files work on Windows and macOS and fail on Linux.
    """
    path = base / relative if relative else base
    if exists(path):
        return path, ""
    # Only here: what reads build files is a third of what a node imports for its workspace.
    from gazelle.workspace.installed_files import installed_source

    source = installed_source(path.absolute())
    if source is not None:
        return source, ""
    found = _ignoring_case(base, relative)
    if found is None:
        return None, ""
    shown = os.path.relpath(found, base)
    return found, f"upper and lower case differ: the file is '{shown}', written was '{relative}'"


def nearest_below(base: Path, relative: str) -> tuple[str, ...]:
    """Return names like the missing part of `relative`, from the deepest folder that exists."""
    parts = [part for part in Path(relative).parts if part not in {"", "/"}]
    folder = base
    for index, part in enumerate(parts):
        if exists(folder / part):
            folder = folder / part
            continue
        near = nearest_names(part, _names_in(folder))
        rest = parts[:index]
        names = ["/".join([*rest, name]) for name in near]
        behind = "/".join(parts[index + 1 :])
        whole = [f"{name}/{behind}" for name in names if behind and exists(base / name / behind)]
        if whole or not behind:
            return tuple(whole or names)
        elsewhere = _of_name_below(base, parts[-1])
        return elsewhere or tuple(names)
    return ()


def _of_name_below(base: Path, name: str) -> tuple[str, ...]:
    """Return where files of a name lie in a package or model, the highest first."""
    if not is_folder(base) or len(base.parts) <= 2:
        return ()
    found = []
    for number, (folder, folders, files) in enumerate(os.walk(base)):
        folders[:] = sorted(item for item in folders if not item.startswith("."))
        if name in files:
            found.append(os.path.relpath(os.path.join(folder, name), base))  # noqa: PTH118
        if number >= _MAX_FOLDERS or len(found) >= 3:
            break
    return tuple(sorted(found, key=lambda item: (item.count("/"), item)))


def nearest_packages(name: str, existing: Iterable[str]) -> tuple[str, ...]:
    """Return package names like a missing one; a common ending alone is no likeness."""
    names = list(existing)
    stem = _stem(name)
    near = [
        item
        for item in nearest_names(name, names)
        if stem == name or nearest_names(stem, [_stem(item)])
    ]
    siblings = sorted(item for item in names if _stem(item) == stem)
    return tuple(dict.fromkeys([*near, *siblings]))[:3]


def _stem(name: str) -> str:
    for ending in _COMMON_ENDINGS:
        if name.endswith(ending) and name != ending:
            return name.removesuffix(ending)
    return name


def _ignoring_case(base: Path, relative: str) -> Path | None:
    folder = base
    for part in Path(relative).parts:
        if part == "..":
            folder = folder.parent
            continue
        if not exists(folder / part):
            same = [name for name in _names_in(folder) if name.casefold() == part.casefold()]
            if len(same) != 1:
                return None
            part = same[0]  # noqa: PLW2901
        folder = folder / part
    return folder if exists(folder) else None


def _names_in(folder: Path) -> list[str]:
    try:
        return sorted(os.listdir(folder))  # noqa: PTH208
    except OSError:
        return []
