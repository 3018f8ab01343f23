"""The whole set of damaged files: 100,000, a fifth of each kind.

    python benchmarks/soak/fuzz.py [--count N]

`tests/test_fuzz.py` runs the first 3,000 of them in every test run.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.test_fuzz import SOURCES, refusals


def main() -> None:
    """Print how many files of each kind were refused; stops at the first crash."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100_000)
    each = parser.parse_args().count // len(SOURCES)
    for kind in SOURCES:
        start = time.perf_counter()
        refused = refusals(kind, each)
        seconds = time.perf_counter() - start
        print(f"{kind:<12}{each:>8} files, {refused:>8} refused, 0 crashes, {seconds:6.1f} s")


if __name__ == "__main__":
    main()
