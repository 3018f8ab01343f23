"""The command line of ``xacro``, as launch files and shells use it."""

from __future__ import annotations

import contextlib
import io
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

__all__ = ["XacroCommand", "parse_xacro_arguments", "read_xacro_arguments"]

# Options of xacro before ROS Noetic, with what has become of them.
_OLD = {
    "--xacro-ns": "tags without the prefix 'xacro:' are taken and told in ROS 1",
    "--check-order": "files are always processed in order since ROS Melodic",
    "--oldorder": "files are always processed in order since ROS Melodic",
    "--legacy": "files are always processed in order since ROS Melodic",
    "--includes": "processing only includes ended with ROS Kinetic",
}
_LONG_OUTPUT = "--output"


@dataclass(frozen=True, slots=True)
class XacroCommand:
    """What one call of ``xacro`` asks for.

    Attributes:
        file: the input file, as written.
        mappings: values of ``<xacro:arg>`` by name.
        output: file to write to, empty for standard output.
        root_dir: folder that relative includes start from, empty for the current one.
        just_deps: print the files included instead of the result.
        verbosity: 0 without warnings' places, 1 the default, from 2 on with traceback, from 3 on
            with every property.
        notices: options that have no effect any more, in words.
    """

    file: str
    mappings: Mapping[str, str] = field(default_factory=dict)
    output: str = ""
    root_dir: str = ""
    just_deps: bool = False
    verbosity: int = 1
    notices: tuple[str, ...] = ()


def read_xacro_arguments(arguments: Sequence[str]) -> XacroCommand:
    """Read the arguments after the word ``xacro`` as the official program does, by its own parser.

    Its help and its complaints go to standard output and standard error. Options of older
    generations are accepted.

    Args:
        arguments: options, ``name:=value`` and the input file, in any order.

    Raises:
        SystemExit: ``-h`` (0) or wrong options (2); the reason has been printed.
        RuntimeError: a word has more than one ``:=``.
    """
    from xacro import color
    from xacro.cli import process_args

    argv, notices = _without_old(arguments)
    with _program_named("xacro"), _colouring_of(color):
        options, file = process_args(argv)
    return XacroCommand(
        str(file),
        dict(options.mappings),
        options.output or "",
        options.root_dir or "",
        bool(options.just_deps),
        # "-v" counts up from the default; "--verbosity 0 -v" from there.
        int(options.verbosity or 0),
        notices,
    )


def parse_xacro_arguments(arguments: Sequence[str]) -> XacroCommand:
    """Read the arguments after the word ``xacro`` where nobody looks at standard error.

    Args:
        arguments: as in `read_xacro_arguments`.

    Raises:
        ValueError: an option is unknown or lacks its value, or there is not exactly one file.
    """
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
            return read_xacro_arguments(arguments)
    except SystemExit as stop:
        lines = said.getvalue().strip().splitlines() or [""]
        raise ValueError(lines[-1] if stop.code else "xacro: -h asks for help only") from None
    except RuntimeError as error:
        raise ValueError(f"xacro: {str(error).strip()}") from error


def _without_old(arguments: Sequence[str]) -> tuple[list[str], tuple[str, ...]]:
    argv: list[str] = []
    notices: list[str] = []
    for token in arguments:
        if token in _OLD:
            notices.append(f"option {token} has no effect: {_OLD[token]}")
        elif token.partition("=")[0] == _LONG_OUTPUT and ":=" not in token:
            notices.append(f"option {_LONG_OUTPUT} is not xacro's; its name there is -o")
            argv += ["-o", *token.split("=", 1)[1:]]
        else:
            argv.append(token)
    return argv, tuple(notices)


@contextlib.contextmanager
def _colouring_of(color: Any) -> Iterator[None]:
    """Let complaints have colour where they go to; the library asks where they went at import."""
    before = color.is_tty
    color.is_tty = lambda _stream: sys.stderr.isatty()
    try:
        yield
    finally:
        color.is_tty = before


@contextlib.contextmanager
def _program_named(name: str) -> Iterator[None]:
    """Let help and complaints name the program, whoever runs it."""
    before: Any = sys.argv
    sys.argv = [name, *before[1:]]
    try:
        yield
    finally:
        sys.argv = before
