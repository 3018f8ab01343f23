"""Writes the page's generated sources: ``python -m gazelle.studio.typescript``, in the repository.

A folder may be named; the usual one is ``studio/src/generated``.
"""

from __future__ import annotations

import sys
from pathlib import Path

from gazelle.studio.typescript.sources import FILES, FOLDER

if __name__ == "__main__":
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else FOLDER)
    for name, text in FILES.items():
        (folder / name).write_text(text(), encoding="utf-8", newline="\n")
