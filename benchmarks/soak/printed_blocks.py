"""Runs every code block of the README and of the documentation as printed, page by page.

python benchmarks/soak/printed_blocks.py [--packages DIR] [PAGE …]

A page (``howto/bags``, ``README``) begins in an empty folder that is the reader's home, on a graph
of its own. Pages that need the workspaces of the tutorials or TurtleBot3's are told and left out
where ``--packages`` (a folder with ``catkin_ws``, ``ros2_ws``, ``turtlebot3_ws``) is not there. The
last lines are a table: blocks that were run, blocks that are marked, seconds. The exit code is 1
where a page does something else than it says.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.documentation.blocks import Block, blocks_of, pages_of  # noqa: E402
from tests.documentation.page_runner import BlockFailure, run_page  # noqa: E402

_FIRST_PORT = 17_447


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pages", nargs="*", metavar="PAGE")
    parser.add_argument(
        "--packages", type=Path, default=ROOT.parent / "shared" / "workspaces", metavar="DIR"
    )
    parser.add_argument("--patience", type=float, default=240.0, metavar="SECONDS")
    options = parser.parse_args()
    packages = options.packages if options.packages.is_dir() else None
    failed, rows = 0, []
    for number, page in enumerate(_asked(options.pages)):
        name, blocks = _name(page), blocks_of(page)
        if not any(block.is_run for block in blocks):
            rows.append((name, blocks, 0.0, "-"))
            continue
        if packages is None and any("$PACKAGES" in one.marks.get("before", "") for one in blocks):
            rows.append((name, blocks, 0.0, "left out: no packages"))
            continue
        print(f"{name} …", flush=True)
        started, said = time.monotonic(), "as printed"
        port = _FIRST_PORT + os.getpid() % 200 * 100 + number
        with tempfile.TemporaryDirectory(prefix="page-", ignore_cleanup_errors=True) as folder:
            try:
                run_page(
                    page, Path(folder), port=port, packages=packages, patience_s=options.patience
                )
            except BlockFailure as failure:
                failed, said = failed + 1, str(failure).splitlines()[0]
                print(failure, flush=True)
        rows.append((name, blocks, time.monotonic() - started, said))
    print(_table(rows))
    return int(failed > 0)


def _asked(names: list[str]) -> list[Path]:
    pages = pages_of(ROOT)
    return [page for page in pages if not names or _name(page) in names]


def _name(page: Path) -> str:
    return str(page.relative_to(ROOT).with_suffix("")).removeprefix("docs/")


def _table(rows: list[tuple[str, list[Block], float, str]]) -> str:
    lines, whole = ["| page | run | saved | output | marked | s | |", "|-|-|-|-|-|-|-|"], Counter()
    for name, blocks, wall_s, said in rows:
        counts = Counter(map(_kind, blocks))
        whole += counts
        if blocks:
            kinds = " | ".join(str(counts[kind]) for kind in ("run", "saved", "output", "marked"))
            lines.append(f"| {name} | {kinds} | {wall_s:.0f} | {said} |")
    kinds = " | ".join(str(whole[kind]) for kind in ("run", "saved", "output", "marked"))
    return "\n".join([*lines, f"| all | {kinds} | {sum(row[2] for row in rows):.0f} | |"])


def _kind(block: Block) -> str:
    if block.is_run:
        return "run"
    if "file" in block.marks:
        return "saved"
    if block.is_output:
        return "output"
    return "marked" if "not run" in block.marks else "shown"


if __name__ == "__main__":
    sys.exit(main())
