"""Run with all their cases the tests that otherwise run a part of them; see ``tests/sets.py``.

python benchmarks/soak/whole_sets.py [ARGUMENTS OF PYTEST…]
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

TESTS = Path(__file__).parents[2] / "tests"


def files() -> list[str]:
    """Return the test files that ask how much to run."""
    return [
        str(path)
        for path in sorted(TESTS.rglob("test_*.py"))
        if "tests.sets import" in path.read_text(encoding="utf-8")
    ]


def main() -> int:
    """Run them; return the exit code."""
    command = [sys.executable, "-m", "pytest", *files(), *sys.argv[1:]]
    environ = {**os.environ, "GAZELLE_WHOLE_SETS": "1"}
    return subprocess.run(command, cwd=TESTS.parent, env=environ, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
