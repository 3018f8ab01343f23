"""Robot descriptions of our own with what the real programs made of them.

``NAME.v12.sdf`` and ``NAME.v12.txt`` are what ``ign sdf -p NAME.urdf`` of sdformat 12.3.0 wrote to
standard output and standard error, ``v9`` those of Gazebo 11's ``gz sdf -p`` (sdformat 9.3.0).
"""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from gazelle.description.sdformat import Release
from gazelle.description.sdformat.document import read_document, to_text
from gazelle.description.sdformat.urdf import urdf_to_sdf
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics

from .comparing import differences
from .random_robots import random_robot

RECORDED = Path(__file__).with_name("recorded")
NAMES = sorted(path.stem for path in RECORDED.glob("*.urdf"))


def _printed(text: str, release: Release) -> str:
    root = read_document(text, release=release, file="r.urdf", find=lambda _word: None).root
    assert root is not None
    return to_text(root, release)


@pytest.mark.reference
@pytest.mark.parametrize("release", Release, ids=lambda item: f"v{item.value}")
@pytest.mark.parametrize("name", NAMES)
def test_recorded_robots(name: str, release: Release) -> None:
    text = (RECORDED / f"{name}.urdf").read_text(encoding="utf-8")
    theirs = (RECORDED / f"{name}.v{release.value}.sdf").read_text(encoding="utf-8")
    assert differences(_printed(text, release), theirs) == []


@pytest.mark.reference
@pytest.mark.parametrize("release", Release, ids=lambda item: f"v{item.value}")
@pytest.mark.parametrize("name", NAMES)
def test_recorded_remarks(name: str, release: Release) -> None:
    file = RECORDED / f"{name}.urdf"
    root = parse_xml(file.read_text(encoding="utf-8"), str(file), Diagnostics())
    assert root is not None
    remarks: list[str] = []
    urdf_to_sdf(root, release=release, remarks=remarks)
    ours = "".join(f"{remark}\n" for remark in remarks).replace("./urdf_parser", "urdf_parser")
    theirs = (RECORDED / f"{name}.v{release.value}.txt").read_text(encoding="utf-8")
    assert ours == theirs


@pytest.mark.reference
@pytest.mark.parametrize("seed", range(4))
def test_the_real_program_agrees_where_it_is_installed(seed: int, tmp_path: Path) -> None:
    program = shutil.which("ign", path="/usr/bin:/usr/local/bin")
    if program is None:
        pytest.skip("ign is not installed (apt-get install ignition-tools sdformat-sdf)")
    file = tmp_path / "robot.urdf"
    file.write_text(random_robot(seed), encoding="utf-8")
    words = [program, "sdf", "-p", str(file)]
    done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=60)
    if "Unknown command" in done.stderr or not re.search("<sdf", done.stdout):
        pytest.skip(f"this ign has no sdf command: {done.stderr[:200]}")
    assert differences(_printed(random_robot(seed), Release.V12), done.stdout) == []
