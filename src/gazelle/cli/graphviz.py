"""Graphviz's ``dot``: drawings from the text that a tool wrote."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

__all__ = ["typeset"]

_INSTALL = (
    "install Graphviz (apt-get install graphviz, brew install graphviz or "
    "winget install Graphviz.Graphviz) and run this again"
)


def typeset(source: Path, target: Path, tool: str) -> bool:
    """Write a PDF file; False, said why on standard error, when `dot` is missing or fails.

    Args:
        source: a file in Graphviz's language.
        target: the file to write.
        tool: who says so.
    """
    dot = shutil.which("dot")
    if dot is None:
        message = f"'{target}' was not made: the program 'dot' is not here; {_INSTALL}"
        print(f"{tool}: {message}", file=sys.stderr)
        return False
    # Absolute, so that no name is taken for an option.
    command = [dot, "-Tpdf", str(source.absolute()), "-o", str(target.absolute())]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, check=False)
    if done.returncode:
        message = f"'{target}' was not made: dot ended with exit code {done.returncode}"
        print(f"{tool}: {message}", file=sys.stderr)
    return done.returncode == 0
