"""A config package on disk: which of its files are new, as they were written, or edited since."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path
from typing import Any

from gazelle.documents.files import is_file
from gazelle.documents.yaml import YamlError, load_yaml
from gazelle.errors import GazelleError
from gazelle.motion.setup_assistant.config import SetupAssistantConfig
from gazelle.motion.setup_assistant.ros1_package import ros1_files
from gazelle.motion.setup_assistant.ros2_package import ros2_files
from gazelle.motion.setup_assistant.texts import setup_assistant_file

__all__ = [
    "SETUP_FILE",
    "FileState",
    "PlannedFile",
    "SetupAssistantError",
    "planned_files",
    "write_package",
]

SETUP_FILE = ".setup_assistant"


class SetupAssistantError(GazelleError):
    """A package cannot be read or written; says why."""


class FileState(Enum):
    """How a file that is to be written stands to the one on disk."""

    NEW = "new"
    SAME = "same"
    CHANGED = "changed"
    EDITED = "edited"


@dataclass(frozen=True, slots=True)
class PlannedFile:
    """A file of a package that is to be written.

    Attributes:
        path: in the package.
        text: what will be in it.
        state: NEW is not there yet, SAME is there as it is, CHANGED is there as it was written
            last and will be another, EDITED is there and somebody else wrote it.
    """

    path: str
    text: str
    state: FileState


def planned_files(config: SetupAssistantConfig, folder: Path) -> tuple[PlannedFile, ...]:
    """Return all files of a package as they would be written, sorted.

    Args:
        config: what was chosen.
        folder: of the package; it need not be there.

    Raises:
        SetupAssistantError: a file that is there cannot be read.
    """
    texts = ros1_files(config) if config.ros_version == 1 else ros2_files(config)
    known = _digests(folder)
    texts[SETUP_FILE] = setup_assistant_file(
        config, {path: _digest(text) for path, text in texts.items()}
    )
    return tuple(
        PlannedFile(path, text, _state(folder / path, text, known.get(path)))
        for path, text in sorted(texts.items())
    )


def write_package(
    config: SetupAssistantConfig, folder: Path, *, overwrite: Collection[str] = ()
) -> tuple[PlannedFile, ...]:
    """Write a package's files, but none that somebody edited.

    Args:
        config: what was chosen.
        folder: of the package; made when it is not there.
        overwrite: paths of edited files to be written all the same.

    Returns:
        The files that were written.

    Raises:
        SetupAssistantError: a file cannot be read or written.
    """
    wanted = planned_files(config, folder)
    skipped = {
        item.path
        for item in wanted
        if item.state is FileState.EDITED and item.path not in overwrite and item.path != SETUP_FILE
    }
    if skipped:
        # What stays edited must not count as written the next time.
        known = _digests(folder)
        digests = {
            item.path: known.get(item.path, "") if item.path in skipped else _digest(item.text)
            for item in wanted
            if item.path != SETUP_FILE
        }
        text = setup_assistant_file(config, digests)
        wanted = tuple(
            replace(item, text=text) if item.path == SETUP_FILE else item for item in wanted
        )
    written = tuple(
        item for item in wanted if item.state is not FileState.SAME and item.path not in skipped
    )
    for item in written:
        path = folder / item.path
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(item.text, encoding="utf-8", newline="\n")
        except OSError as error:
            raise SetupAssistantError(f"cannot write {path}: {error.strerror}") from error
    return written


def _state(path: Path, text: str, known: str | None) -> FileState:
    if not is_file(path):
        return FileState.NEW
    there = _read(path)
    if there == text:
        return FileState.SAME
    if path.name == SETUP_FILE or _digest(there) == known:
        return FileState.CHANGED
    return FileState.EDITED


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise SetupAssistantError(f"cannot read {path}: {error}") from error


def _digests(folder: Path) -> Mapping[str, str]:
    path = folder / SETUP_FILE
    if not is_file(path):
        return {}
    try:
        tree: Any = load_yaml(_read(path))
    except YamlError as error:
        raise SetupAssistantError(f"cannot read {path}: {error}") from error
    for key in ("moveit_setup_assistant_config", "gazelle", "files"):
        tree = tree.get(key) if isinstance(tree, dict) else None
    return {str(key): str(value) for key, value in tree.items()} if isinstance(tree, dict) else {}


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8")).hexdigest()[:16]
