"""What the README says can be done, can be done."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
from tests.patience import stretched

from gazelle.cli.commands import COMMANDS

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_test_command_is_the_one_that_ci_runs() -> None:
    command = 'pip install -e ".[dev]" && ruff format --check && ruff check && mypy -n 2 && {'
    command += " pytest -n auto; first=$?;"
    command += ' pytest tests/browser -m "not slow" && (exit $first); }'
    assert f"```bash\n{command}\n" in README
    assert f"\n{command}\n" in (ROOT / ".ci" / "run").read_text(encoding="utf-8")


def test_commands_named_exist() -> None:
    row = next(line for line in README.splitlines() if line.startswith("| commands"))
    assert set(row.split("`")[1].split()) <= set(COMMANDS)


def test_links_lead_somewhere() -> None:
    for target in re.findall(r"\]\(([\w./-]+)\)", README):
        assert (ROOT / target).is_file(), target


@pytest.mark.tutorial
def test_example_drives_senses_and_repeats(tmp_path: Path) -> None:
    outputs = []
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, str(ROOT / "examples" / "drive_scout.py")],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=False,
            timeout=stretched(120),
        )
        assert done.returncode == 0, done.stderr
        outputs.append(done.stdout)
    assert outputs[0] == outputs[1]
    x, y, yaw = map(
        float, re.findall(r"x (-?[\d.]+) m, y (-?[\d.]+) m, yaw (-?[\d.]+) rad", outputs[0])[-1]
    )
    assert x == pytest.approx(2.0, rel=0.02)
    assert y == pytest.approx(0.0, abs=0.01)
    assert yaw == pytest.approx(1.5708, rel=0.03)
    assert (tmp_path / "scout.png").read_bytes().startswith(b"\x89PNG")
