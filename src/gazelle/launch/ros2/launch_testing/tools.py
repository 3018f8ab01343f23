"""launch_testing.tools: expecting output, and processes that a test starts."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from gazelle.launch.ros2.launch_testing.output_text import (
    build_line_match,
    build_text_match,
    remove_ansi_escape_sequences,
)
from gazelle.launch.ros2.launch_testing.process_proxy import ProcessProxy, launch_process

__all__ = [
    "ProcessProxy",
    "basic_output_filter",
    "expect_output",
    "expected_output_from_file",
    "launch_process",
]

_PREFIXES = ("pid", "rc")


def basic_output_filter(
    filtered_prefixes: Iterable[str] | None = None, filtered_patterns: Iterable[str] | None = None
) -> Callable[[str], str]:
    """Return a function that takes lines out of a text.

    Args:
        filtered_prefixes: beginnings of such lines, ``pid`` and ``rc`` when None.
        filtered_patterns: regular expressions of such lines.
    """
    prefixes = tuple(_PREFIXES if filtered_prefixes is None else filtered_prefixes)
    patterns = [re.compile(one) for one in filtered_patterns or ()]

    def kept(line: str) -> bool:
        return not line.startswith(prefixes) and not any(one.match(line) for one in patterns)

    return lambda output: "".join(filter(kept, output.splitlines(keepends=True)))


def expected_output_from_file(path: str, encoding: str | None = None) -> list[Any]:
    """Return the lines of ``PATH.txt``, or the regular expressions of ``PATH.regex``.

    Raises:
        RuntimeError: there is neither.
    """
    for ending, make in ((".txt", str), (".regex", re.compile)):
        file = Path(f"{path}{ending}")
        if file.is_file():
            lines = file.read_text(encoding=encoding or "utf-8").splitlines()
            return [make(line) for line in lines]
    raise RuntimeError(f"could not find output check file: {path}")


def expect_output(
    text: str | None = None,
    *,
    lines: list[str] | None = None,
    expected_text: Any = None,
    expected_lines: Any = None,
    strip_ansi_escape_sequences: bool = True,
    strict: bool = False,
) -> bool:
    """Return whether a text or lines have what is expected; see `build_text_match`.

    Raises:
        ValueError: not one of text and lines is given, or not one of the expected ones.
    """
    if (text is None) == (lines is None):
        raise ValueError("Either lines or text, but not both, must be specified")
    if (expected_text is None) == (expected_lines is None):
        raise ValueError("Either expected lines or text, but not both, must be specified")
    whole = "\n".join(lines or ()) if text is None else text
    if strip_ansi_escape_sequences:
        whole = remove_ansi_escape_sequences(whole)
    if expected_text is not None:
        return build_text_match(expected_text, strict=strict)(whole) is not None
    return build_line_match(expected_lines, strict=strict)(whole.splitlines()) is not None
