"""Recorded outputs of the real programs."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest


class Recorded(NamedTuple):
    """One run of the real ``check_urdf``."""

    text: str
    code: int
    out: str
    err: str


@pytest.fixture
def recorded(oracles_dir: Path) -> Callable[[str], Recorded]:
    """What the real ``check_urdf`` made of a file: ``recorded("good")``."""

    def read(name: str) -> Recorded:
        answer = (oracles_dir / "check_urdf" / f"{name}.txt").read_text(encoding="utf-8")
        match = re.fullmatch(
            r"\$ [^\n]*\n\[exit (\d+)\]\n\[stdout\]\n(.*?)\[stderr\]\n?(.*)", answer, re.DOTALL
        )
        assert match is not None, name
        text = (oracles_dir / "urdf" / f"{name}.urdf").read_text(encoding="utf-8")
        return Recorded(text, int(match[1]), match[2], match[3])

    return read
