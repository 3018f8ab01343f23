"""The names of ROS's Python packages are here, refused with a sentence, or listed as missing.

``original_names`` holds a file per package: a line per name with the words that it takes and the
distributions that have it (Kinetic, Melodic, Noetic, Humble, Jazzy, Rolling). ``missing`` is what
is not here yet; it can only become shorter.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from gazelle.compat.refused import REFUSED, refusal_of

NAMES = Path(__file__).parent / "original_names"
_FAMILIES = (
    "launch",
    "controller_manager",
    "nav2_common",
    "ros_gz_bridge",
    "ament_index_python",
    "rospy",
)


@pytest.mark.parametrize("package", _FAMILIES)
def test_names_of_the_original_are_here_or_known_to_be_missing(package: str) -> None:
    command = [sys.executable, "-m", "gazelle.compat.runner", str(NAMES / "compare.py")]
    done = subprocess.run(
        [*command, str(NAMES / f"{package}.txt")],
        capture_output=True,
        text=True,
        check=True,
        env=dict(os.environ),
    )
    missing = set(json.loads(done.stdout.partition("RESULT")[2]))
    known = {
        line
        for line in (NAMES / "missing").read_text(encoding="utf-8").splitlines()
        if line.split(".")[0] == package
    }
    assert missing == known


def test_refused_modules_say_what_they_are() -> None:
    assert [row.module for row in REFUSED] == sorted({row.module for row in REFUSED})
    sentence = refusal_of("osrf_pycommon.process_utils")
    assert sentence is not None
    assert sentence.startswith("No module named 'osrf_pycommon.process_utils': gazelle: it is part")
    assert "pip install osrf-pycommon" in sentence
    assert refusal_of("rclpy.node") is None
    listed = {
        line.split(" ")[0].split("(")[0]
        for file in NAMES.glob("*.txt")
        for line in file.read_text(encoding="utf-8").splitlines()
    }
    assert {row.module for row in REFUSED} <= listed


def test_imports_of_refused_modules_end_with_their_sentence() -> None:
    program = "from rclpy.waitable import Waitable"
    file = "import gazelle.compat.finder as f; f.install(); " + program
    modules = Path(__file__).parents[2] / "src" / "gazelle" / "compat" / "modules"
    done = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(modules)!r}); {file}"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert "gazelle: it is rclpy's inside, made around rcl" in done.stderr
