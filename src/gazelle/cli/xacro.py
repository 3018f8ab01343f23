"""``xacro file [name:=value …] [-o out]``: the official expander with our package look-up."""

from __future__ import annotations

import os
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

from gazelle.description.source_maps import remember
from gazelle.description.xacro import XacroCommand, expand_xacro, read_xacro_arguments
from gazelle.diagnostics import Diagnostics, render
from gazelle.workspace import Workspace

__all__ = ["main"]

_FAILED = 2
_WITH_TRACEBACK = 2


def main(argv: list[str]) -> int:
    """Expand a file to standard output or to ``-o``.

    Returns:
        0; 2 for wrong options and for files that cannot be expanded; 1 where the official
        program ends with a traceback, which it does from ``-v`` on.
    """
    try:
        command = read_xacro_arguments(argv)
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else 1
    except RuntimeError as error:
        print(f"RuntimeError: {str(error).strip()}", file=sys.stderr)
        return 1
    for notice in command.notices:
        print(f"xacro: {notice}", file=sys.stderr)
    return _expand(command)


def _expand(command: XacroCommand) -> int:
    diagnostics = Diagnostics()
    expanded = expand_xacro(
        command.file,
        mappings=command.mappings,
        workspace=Workspace.discover(),
        diagnostics=diagnostics,
        root_dir=command.root_dir,
        verbosity=command.verbosity,
        console=_say,
    )
    if expanded is None:
        render(diagnostics)
        is_xacro = diagnostics.errors[0].code not in {"xml.malformed", "xacro.no-namespace"}
        return 1 if command.verbosity >= _WITH_TRACEBACK and is_xacro else _FAILED
    if command.just_deps:
        text = " ".join(expanded.dependencies)
    else:
        text = expanded.text
        remember(expanded)
    code = _write(text, command.output)
    if len(diagnostics):
        sys.stdout.flush()
        render(diagnostics)
    return code


def _say(text: str) -> None:
    sys.stderr.write(text)


def _write(text: str, output: str) -> int:
    if not output:
        sys.stdout.write(text)
        return 0
    try:
        _write_file(text, Path(output))
    except OSError as error:
        print(f"error: Failed to open output: {error}", file=sys.stderr)
        return _FAILED
    return 0


def _write_file(text: str, path: Path) -> None:
    """Write a file so that nobody ever sees half of it; its folder is made."""
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
    if path.exists() and not path.is_file():
        # Such as /dev/stdout, which cannot be replaced.
        path.write_text(text, encoding="utf-8")
        return
    target = path.resolve()
    mode = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~_umask()
    number, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(number, "w", encoding="utf-8") as stream:
            stream.write(text)
        Path(name).chmod(mode)
        Path(name).replace(target)
    except OSError:
        Path(name).unlink(missing_ok=True)
        raise


def _umask() -> int:
    found = os.umask(0)
    os.umask(found)
    return found
