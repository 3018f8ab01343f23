"""Random robot descriptions, converted to SDF by the real programs and by Gazelle.

    python benchmarks/soak/sdf_conversion.py [--count N] [--first N] [--gazebo-root DIR]

`ign sdf -p` (sdformat 12) must be installed; a folder with Debian 11 and Gazebo 11 in it, for
``chroot DIR gz sdf -p``, adds sdformat 9. Prints every description that comes out differently.
"""

from __future__ import annotations

import argparse
import collections
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.description.sdformat_emulation.comparing import differences
from tests.description.sdformat_emulation.random_robots import random_robot

from gazelle.description.sdformat_emulation import Release
from gazelle.description.sdformat_emulation.gz_sdf_command import read_document, to_text

_CRASHES = (-6, -11, 134, 139)


def main() -> None:
    """Compare descriptions one by one; the exit code tells whether one differed."""
    options = _options()
    program = shutil.which("ign", path="/usr/bin:/usr/local/bin")
    if program is None:
        print("skipped: ign is not installed (apt-get install ignition-tools sdformat-sdf)")
        return
    outcomes: collections.Counter[str] = collections.Counter()
    for seed in range(options.first, options.first + options.count):
        outcomes[_outcome(seed, Release.V12, [program], Path(tempfile.gettempdir()), "")] += 1
        if options.gazebo_root:
            words = ["chroot", options.gazebo_root, "gz"]
            folder = Path(options.gazebo_root) / "tmp"
            outcomes[_outcome(seed, Release.V9, words, folder, options.gazebo_root)] += 1
    print(", ".join(f"{count} {outcome}" for outcome, count in outcomes.most_common()))
    sys.exit(1 if outcomes["different"] else 0)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--gazebo-root", default="")
    return parser.parse_args()


def _outcome(seed: int, release: Release, words: list[str], folder: Path, root: str) -> str:
    text = random_robot(seed)
    with tempfile.NamedTemporaryFile("w", suffix=".urdf", dir=folder) as file:
        file.write(text)
        file.flush()
        name = file.name.removeprefix(root)
        done = subprocess.run(
            [*words, "sdf", "-p", name], capture_output=True, text=True, check=False, timeout=120
        )
    ours = read_document(text, release=release, file=name, find=lambda _word: None).root
    if not done.stdout.strip():
        if ours is None:
            return "refused by both"
        if done.returncode in _CRASHES:
            return "crashes of the real program"
        print(f"seed {seed}, {release.name}: only the real program refuses it\n{done.stderr}")
        return "different"
    if ours is None:
        print(f"seed {seed}, {release.name}: only Gazelle refuses it")
        return "different"
    found = differences(to_text(ours, release), done.stdout)
    for line in found:
        print(f"seed {seed}, {release.name}: {line}")
    return "different" if found else "equal"


if __name__ == "__main__":
    main()
