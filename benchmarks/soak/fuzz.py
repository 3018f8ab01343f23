"""The whole set of damaged files: a million, as many of each kind.

    python benchmarks/soak/fuzz.py [--count N] [--first N] [--guided] [KIND ...]

Every kind is read in a process of its own with 4 GiB of memory. Numbers of files that crash, take
more than a second or give other findings when they are read again are printed, and the exit code
is 1 then. With ``--guided`` files that reach new lines of Gazelle are damaged further, and the
bytes are printed. `tests/test_fuzz.py` reads the first ones in every test run.
"""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.fuzzing.guided import read_guided
from tests.fuzzing.kinds import KINDS
from tests.fuzzing.run import Outcome, read_damaged

_MEMORY_BYTES = 4 << 30
_MAX_S = 1.0


def main() -> int:
    """Print a line for each kind of file."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=f"of {', '.join(KINDS)}")
    parser.add_argument("--count", type=int, default=1_000_000)
    parser.add_argument("--first", type=int, default=0, help="number of the first file")
    parser.add_argument("--guided", action="store_true", help="damage what reaches new lines")
    options = parser.parse_args()
    kinds = options.kinds or list(KINDS)
    each = range(options.first, options.first + options.count // len(kinds))
    crashes = 0
    context = multiprocessing.get_context("spawn")
    for name in kinds:
        start_s = time.perf_counter()
        with context.Pool(1) as pool:
            outcome = pool.apply(_read, (name, each, options.guided))
        crashes += len(outcome.crashes)
        print(
            f"{name:<20}{outcome.files:>7} files {outcome.refused:>7} refused "
            f"{len(outcome.crashes):>3} crashes {time.perf_counter() - start_s:8.1f} s, "
            f"slowest {outcome.slowest_s:5.2f} s (number {outcome.slowest})",
            flush=True,
        )
        for number, text in outcome.crashes.items():
            print(f"    {number}: {text[:300]}", flush=True)
    return int(crashes > 0)


def _read(name: str, numbers: range, guided: bool) -> Outcome:
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY_BYTES, _MEMORY_BYTES))
    with tempfile.TemporaryDirectory() as folder:
        read = read_guided if guided else read_damaged
        return read(KINDS[name], numbers, Path(folder), most_s=_MAX_S)


if __name__ == "__main__":
    sys.exit(main())
