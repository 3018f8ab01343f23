"""``xacro file [name:=value …] [-o out]``: the official expander with our package look-up."""

from __future__ import annotations

import sys
from pathlib import Path

from gazelle.description.xacro import expand_xacro, parse_xacro_arguments
from gazelle.diagnostics import Diagnostics, render
from gazelle.workspace import Workspace

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Expand a file to standard output or to ``-o``."""
    if not argv or argv[0] in {"-h", "--help"}:
        print("usage: xacro [options] <input> [name:=value ...] [-o OUTPUT]")
        return 0 if argv else 2
    try:
        command = parse_xacro_arguments(argv)
    except ValueError as error:
        print(error, file=sys.stderr)
        return 2
    diagnostics = Diagnostics()
    expanded = expand_xacro(
        command.file,
        mappings=command.mappings,
        workspace=Workspace.discover(),
        diagnostics=diagnostics,
        root_dir=command.root_dir,
    )
    render(diagnostics)
    if expanded is None or diagnostics.errors:
        return 2
    if command.just_deps:
        print(" ".join(expanded.dependencies), end="")
    elif command.output:
        Path(command.output).write_text(expanded.text, encoding="utf-8")
    else:
        sys.stdout.write(expanded.text)
    return 0
