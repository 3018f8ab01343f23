"""Every input printed and checked as the real programs of both releases did it, to the byte."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.shared_files import SHARED, shared_cases

from gazelle.description.sdformat_emulation.gz_sdf_command import (
    Document,
    read_document_file,
    to_text,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.checks import load, name_problems
from gazelle.description.sdformat_emulation.gz_sdf_command.console import error_line
from gazelle.description.sdformat_emulation.release import Release

from .peer import IGN, INPUTS, Output, inputs, neutral, recorded, run_ign

_YARD = Path(__file__).parents[3] / "workspaces/ros1/src/yard_gazebo"

pytestmark = pytest.mark.reference


def _read(name: str, release: Release) -> Document:
    def find(uri: str) -> Path | None:
        path = INPUTS / "models" / uri.removeprefix("model://")
        return path if path.exists() else None

    return read_document_file(str(INPUTS / name), release=release, find=find)


def _printed(name: str, release: Release) -> Output:
    document = _read(name, release)
    errors = [error_line(error, release) for error in document.errors]
    out = "" if document.root is None else to_text(document.root, release)
    refusal = ["Error: SDF parsing the xml failed."] if not out and release is Release.V12 else []
    return Output(out, _text([*document.console.lines, *errors, *refusal]))


def _checked(name: str) -> Output:
    document = _read(name, Release.V12)
    said = list(document.console.lines)
    if document.root is None:
        unread = f"Error Code 1: Msg: Unable to read file:{INPUTS / name}"
        return Output("", _text([*said, *map(str, document.errors), unread]))
    loaded = load(document)
    errors = [*document.errors, *loaded.errors]
    problems = [] if errors else name_problems(document)
    again = [] if errors else said
    lines = [*said, *loaded.console.lines, *map(str, errors), *problems, *again]
    return Output("" if errors or problems else "Valid.\n", _text(lines))


def _text(lines: list[str]) -> str:
    return neutral("".join(f"{line}\n" for line in lines))


@pytest.mark.parametrize("name", inputs())
def test_printed_as_sdformat_12_does(name: str) -> None:
    assert _printed(name, Release.V12) == recorded(name, "print_12")


@pytest.mark.parametrize("name", inputs())
def test_printed_as_sdformat_9_does(name: str) -> None:
    assert _printed(name, Release.V9) == recorded(name, "print_9")


@pytest.mark.parametrize("name", inputs())
def test_judged_as_sdformat_12_does(name: str) -> None:
    assert _checked(name) == recorded(name, "check_12")


@pytest.mark.skipif(not IGN.exists(), reason="ign is not installed (ignition-tools, sdformat-sdf)")
@pytest.mark.parametrize("name", ["types.sdf", "frames.sdf"])
def test_installed_ign_prints_what_was_recorded(name: str) -> None:
    assert run_ign("-p", INPUTS / name) == recorded(name, "print_12")


@pytest.mark.skipif(not IGN.exists(), reason="ign is not installed (ignition-tools, sdformat-sdf)")
@pytest.mark.parametrize("folder", [_YARD, *shared_cases(SHARED / "workspaces/gazebo_models")])
def test_installed_ign_judges_the_workspaces_as_we_do(folder: Path) -> None:
    stages = sorted((folder / "stages").glob("*.sdf"))
    # The first has no link, the last is the whole robot.
    for file in (stages[0], stages[-1]):
        document = read_document_file(str(file), release=Release.V12, find=lambda _uri: None)
        is_valid = document.root is not None and not load(document).errors
        assert (run_ign("-k", file).out == "Valid.\n") == is_valid, file
