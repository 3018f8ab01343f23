"""The real programs, where they are installed, and what they printed where they were."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path
from typing import NamedTuple

from tests.patience import stretched

__all__ = ["IGN", "INPUTS", "Output", "inputs", "neutral", "recorded", "run_ign"]

INPUTS = Path(__file__).parent / "inputs"
IGN = Path("/usr/bin/ign")
_RECORDED = Path(__file__).parent / "recorded"
_BUILD_FOLDER = re.compile(r" /build/\S*/urdf_parser/")
_NOISE = "Library error: libignition-tools-backward.so"


class Output(NamedTuple):
    """What a program printed, paths of the inputs' folder as ``IN``."""

    out: str
    err: str


def inputs() -> list[str]:
    """Return the names of all input documents."""
    return sorted(file.name for file in INPUTS.iterdir() if file.is_file())


def run_ign(option: str, file: Path) -> Output:
    """Run ``ign sdf``; models are looked for among the inputs."""
    environ = os.environ | {"SDF_PATH": str(INPUTS / "models")}
    words = [str(IGN), "sdf", option, str(file)]
    done = subprocess.run(
        words, capture_output=True, text=True, env=environ, timeout=stretched(), check=False
    )
    return Output(done.stdout, neutral(done.stderr))


def recorded(name: str, program: str) -> Output:
    """Return what a program (``print_12``, ``check_12`` or ``print_9``) printed for an input."""
    text = (_RECORDED / f"{name}.{program}.txt").read_text(encoding="utf-8")
    out, _, err = text.partition("[stderr]\n")
    return Output(out, neutral(err))


def neutral(text: str) -> str:
    """Return output without this machine's paths."""
    lines = [line for line in text.splitlines() if not line.startswith(_NOISE)]
    text = "".join(f"{line}\n" for line in lines).replace(str(INPUTS), "IN")
    return _BUILD_FOLDER.sub(" ./urdf_parser/", text)
