"""Executes the notebooks of the documentation whole, each by a real kernel, and judges the outputs.

python benchmarks/soak/notebooks.py [--runs N] [NAME …]

A run is right when no cell fails, every view left something in its cell, and the notebook stays
small. The tests run the same cells in their own process.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

_FOLDER = Path(__file__).parents[2] / "docs" / "notebooks"
_TIMEOUT_S = 900


def main() -> int:
    """Print a line for each run; return how many were wrong."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="notebooks, all when none is named")
    parser.add_argument("--runs", type=int, default=1)
    options = parser.parse_args()
    paths = [one for one in sorted(_FOLDER.glob("*.ipynb")) if one.stem in options.names]
    wrong = 0
    for path in (paths or sorted(_FOLDER.glob("*.ipynb"))) * options.runs:
        begin_s = time.perf_counter()
        problem = _problem(path)
        wrong += bool(problem)
        print(f"{path.stem:20} {time.perf_counter() - begin_s:6.1f} s  {problem or 'right'}")
    return min(wrong, 1)


def _problem(path: Path) -> str:
    book = nbformat.read(path, as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        try:
            NotebookClient(book, kernel_name="python3", timeout=_TIMEOUT_S).execute(cwd=folder)
        except CellExecutionError as error:
            return str(error).strip().splitlines()[-1]
    shown = [output for cell in book.cells for output in cell.get("outputs", ())]
    views = [one for one in shown if one.output_type == "display_data"]
    if not all("srcdoc=" in _html(one) or "<img" in _html(one) for one in views):
        return "a view left nothing in its cell"
    size = len(nbformat.writes(book))
    return "" if size < 4_000_000 else f"the executed notebook has {size} bytes"


def _html(output: Any) -> str:
    return str(output.data.get("text/html", ""))


if __name__ == "__main__":
    raise SystemExit(main())
