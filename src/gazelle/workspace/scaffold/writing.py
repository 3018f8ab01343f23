"""Folders and files of a new package, written with a line printed for each."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from gazelle.workspace.scaffold.scaffold import ScaffoldError

__all__ = ["PackageWriter"]


class PackageWriter:
    """Makes folders and files; tells each to `say`.

    Args:
        say: takes one line.
        folder_words: what a folder's line begins with.
        file_words: what a file's line begins with.
    """

    def __init__(self, say: Callable[[str], None], folder_words: str, file_words: str) -> None:
        self.say = say
        self._folder_words = folder_words
        self._file_words = file_words

    def folder(self, path: Path | str) -> Path:
        """Make a folder.

        Raises:
            ScaffoldError: that is not possible.
        """
        self.say(f"{self._folder_words} {path}")
        made = Path(path)
        try:
            made.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ScaffoldError(f"unable to create folder: {path}: {error.strerror}") from error
        return made

    def file(self, path: Path | str, text: str) -> None:
        """Write a file.

        Raises:
            ScaffoldError: that is not possible.
        """
        self.say(f"{self._file_words} {path}")
        try:
            Path(path).write_text(text, encoding="utf-8", newline="\n")
        except OSError as error:
            raise ScaffoldError(f"cannot write {path}: {error.strerror}") from error
