"""The error about a launch file that no reader can make sense of."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["InvalidLaunchFileError"]


class InvalidLaunchFileError(Exception):
    """A launch file cannot be read.

    Attributes:
        likely_errors: what each reader says, the most likely one first.
    """

    def __init__(
        self, extension: str = "", *, likely_errors: Sequence[BaseException] | None = None
    ) -> None:
        self.likely_errors = tuple(likely_errors or ())
        self._extension = extension
        if not extension or not self.likely_errors:
            text = "The launch file may have a syntax error, or its format is unknown"
        else:
            count = "multiple exceptions" if len(self.likely_errors) > 1 else "exception"
            lines = [f"\n - {type(one).__name__}: {one}" for one in self.likely_errors]
            head = f"Caught {count} when trying to load file of format [{extension}]:"
            text = "".join([head, *lines])
        if self.likely_errors:
            self.__cause__ = self.likely_errors[0]
        super().__init__(text)
