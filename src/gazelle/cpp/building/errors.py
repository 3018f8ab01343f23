"""What goes wrong when C++ is compiled, as errors that say what to do."""

from __future__ import annotations

from gazelle.errors import GazelleError

__all__ = ["CppBuildError", "compiler_failure"]


class CppBuildError(GazelleError):
    """Something of C++ was not built.

    Attributes:
        output: the words of the compiler, the linker or CMake.
        is_no_room: a disk is full.
    """

    def __init__(self, text: str, output: str = "", *, is_no_room: bool = False) -> None:
        super().__init__(text)
        self.output = output
        self.is_no_room = is_no_room


_NO_ROOM = ("No space left on device", "Disk quota exceeded")


def compiler_failure(doing: str, output: str) -> CppBuildError:
    """Return the error for a compiler that ended with a code, by what it printed."""
    if any(words in output for words in _NO_ROOM):
        return CppBuildError(
            f"{doing}: the disk is full; make some room there", output, is_no_room=True
        )
    return CppBuildError(f"{doing} failed:\n{output.strip()}", output)
