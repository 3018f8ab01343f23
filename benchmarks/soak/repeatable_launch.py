"""Is a launch in lock-step the same every time, to the last byte of every message?

    python benchmarks/soak/repeatable_launch.py [--workspaces DIR] [--launches N] [--port N]

Launches document SLAMBOT's robot again and again and compares states and messages with those of
the first time. Exit code 1 when one differs.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from tests.conftest import commands  # noqa: E402
from tests.tutorial.test_repeatable_launch import launch_in_lockstep  # noqa: E402


def main() -> int:
    """Launch and compare."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workspaces", type=Path, default=ROOT.parent / "shared" / "workspaces")
    parser.add_argument("--launches", type=int, default=5)
    parser.add_argument("--port", type=int, default=7842)
    options = parser.parse_args()
    first: Any = None
    bad = 0
    for number in range(options.launches):
        with tempfile.TemporaryDirectory() as folder, commands(Path(folder), options.port) as run:

            def in_workspace(*words: str, run: Any = run) -> Any:
                models = str(options.workspaces / "gazebo_models")
                return run(*words, cwd=options.workspaces / "catkin_ws", GAZEBO_MODEL_PATH=models)

            state_hash, messages = launch_in_lockstep(in_workspace, options.port)
        first = first or (state_hash, messages)
        differ = [topic for topic, items in messages.items() if items != first[1][topic]]
        is_bad = state_hash != first[0] or bool(differ)
        bad += is_bad
        print(
            f"launch {number}: {'differs in ' + str(differ) if is_bad else state_hash}", flush=True
        )
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
