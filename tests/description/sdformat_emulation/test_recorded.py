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
from tests.patience import stretched
from tests.shared_files import SHARED, shared_cases

from gazelle.description.sdformat_emulation import Release
from gazelle.description.sdformat_emulation.gz_sdf_command import read_document, to_text
from gazelle.description.sdformat_emulation.parser_urdf import urdf_to_sdf
from gazelle.description.xacro import expand_xacro
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace

from .comparing import differences
from .random_robots import random_robot

RECORDED = Path(__file__).with_name("recorded")
TESTS = Path(__file__).parents[2]
NAMES = sorted(path.stem for path in RECORDED.glob("*.urdf"))


# sdformat 14 could not be run where these were made.
_RECORDED = (Release.V9, Release.V12)


def _printed(text: str, release: Release) -> str:
    root = read_document(text, release=release, file="r.urdf", find=lambda _word: None).root
    assert root is not None
    return to_text(root, release)


@pytest.mark.reference
@pytest.mark.parametrize("release", _RECORDED, ids=lambda item: f"v{item.value}")
@pytest.mark.parametrize("name", NAMES)
def test_recorded_robots(name: str, release: Release) -> None:
    text = (RECORDED / f"{name}.urdf").read_text(encoding="utf-8")
    theirs = (RECORDED / f"{name}.v{release.value}.sdf").read_text(encoding="utf-8")
    assert differences(_printed(text, release), theirs) == []


@pytest.mark.reference
@pytest.mark.parametrize("release", _RECORDED, ids=lambda item: f"v{item.value}")
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
@pytest.mark.parametrize(
    ("robot", "record", "release"),
    [
        (
            TESTS / "description/converted/trolley.urdf",
            TESTS / "workspaces/recorded/ign_sdf/print_trolley.txt",
            Release.V12,
        ),
        *shared_cases(
            *(
                (SHARED / f"oracles/sdfin/{robot}.urdf", SHARED / "oracles" / record, release)
                for robot, record, release in (
                    ("gz", "sdf/print_gz_urdf.txt", Release.V12),
                    ("surf", "sdf/print_surf_urdf.txt", Release.V12),
                    ("gz", "sdf9/print_gz.txt", Release.V9),
                    ("surf", "sdf9/print_surf.txt", Release.V9),
                )
            )
        ),
    ],
)
def test_printed_robots_with_all_that_sdformat_changes(
    robot: Path, record: Path, release: Release
) -> None:
    text = robot.read_text(encoding="utf-8")
    recorded = record.read_text(encoding="utf-8")
    found = re.search("<sdf .*</sdf>", recorded, re.DOTALL)
    assert found is not None
    assert differences(_printed(text, release), found[0]) == []


@pytest.mark.reference
@pytest.mark.parametrize("seed", range(4))
def test_random_robots_where_the_real_program_is_installed(seed: int, tmp_path: Path) -> None:
    file = tmp_path / "robot.urdf"
    file.write_text(random_robot(seed), encoding="utf-8")
    assert differences(_printed(random_robot(seed), Release.V12), _really_printed(file)) == []


@pytest.mark.reference
@pytest.mark.parametrize(
    ("workspaces", "pattern"),
    [
        (TESTS.parent / "examples", "*.urdf.xacro"),
        (TESTS / "workspaces", "*.urdf"),
        (TESTS / "workspaces", "*.urdf.xacro"),
        *shared_cases((SHARED / "workspaces", "*.urdf"), (SHARED / "workspaces", "*.urdf.xacro")),
    ],
)
def test_robots_of_the_workspaces_where_the_real_program_is_installed(
    workspaces: Path, pattern: str, tmp_path: Path
) -> None:
    files = sorted(workspaces.rglob(pattern))
    assert files
    for file in files:
        folder = next(parent for parent in file.parents if (parent / "src").is_dir())
        workspace = Workspace.discover(environ={}, cwd=folder)
        expanded = expand_xacro(file, workspace=workspace, diagnostics=Diagnostics())
        assert expanded is not None
        copy = tmp_path / "robot.urdf"
        copy.write_text(expanded.text, encoding="utf-8")
        found = differences(_printed(expanded.text, Release.V12), _really_printed(copy))
        assert (str(file), found) == (str(file), [])


def _really_printed(file: Path) -> str:
    program = shutil.which("ign", path="/usr/bin:/usr/local/bin")
    if program is None:
        pytest.skip("ign is not installed (apt-get install ignition-tools sdformat-sdf)")
    words = [program, "sdf", "-p", str(file)]
    done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=stretched())
    if "<sdf" not in done.stdout:
        pytest.skip(f"this ign converts nothing: {done.stderr[:200]}")
    return done.stdout
