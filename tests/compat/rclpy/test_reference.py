"""What a program of many small questions gets from rclpy 9.1.2, it gets here."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

REFERENCE = Path(__file__).with_name("reference")


@pytest.mark.reference
def test_program_of_questions_gets_the_answers_of_rclpy(
    gazelle: Callable[..., Any], graph: Any
) -> None:
    words = (str(REFERENCE / "program.txt"), "example_interfaces")
    running = gazelle(*words, module="gazelle.compat.runner")
    assert running.wait() == 0, running.text
    wanted = (REFERENCE / "rclpy_9_1_2.txt").read_text().splitlines()
    noise = ("[INFO]", "[WARN]", "[ERROR]", "Traceback", "  ", "ValueError")
    got = [line.rstrip() for line in running.lines if not line.startswith(noise)]
    assert [line for line in got if line] == [line.rstrip() for line in wanted]
