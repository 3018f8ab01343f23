"""The file that ``check_urdf`` and ``urdf_to_graphviz`` are given: text, findings, verdict."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import NamedTuple

from gazelle.description.read_context import ReadContext
from gazelle.description.source_maps import placed
from gazelle.description.urdf_reader import read_urdf
from gazelle.description.urdfdom_emulation import Robot, urdfdom_verdict
from gazelle.description.xacro import expand_xacro
from gazelle.description.xml import Tag, parse_xml
from gazelle.description.xml.reader import read_data
from gazelle.diagnostics import Diagnostics, SourceSpan, render
from gazelle.documents.files import exists, is_file, is_folder
from gazelle.workspace import Workspace

__all__ = ["REFUSED", "UrdfFile", "mappings_of", "read_urdf_file", "report_findings", "robot_in"]

REFUSED = 255


class UrdfFile(NamedTuple):
    """A robot description and what our own reader thinks of it.

    Attributes:
        text: what urdfdom is given; None when xacro failed or the document is above a limit, of
            which `diagnostics` tell.
        diagnostics: everything found, also what urdfdom passes in silence.
    """

    text: str | None
    diagnostics: Diagnostics


def mappings_of(argv: list[str]) -> tuple[list[str], dict[str, str]]:
    """Part the words of a command from ``name:=value`` for xacro files."""
    plain = [word for word in argv if ":=" not in word]
    pairs = (word.partition(":=") for word in argv if ":=" in word)
    return plain, {name: value for name, _, value in pairs}


def read_urdf_file(word: str, mappings: dict[str, str]) -> UrdfFile:
    """Read a file, or what a ``package://`` address means; xacro is expanded first.

    A file that cannot be read is an empty text to urdfdom; our reason is among the findings.
    """
    workspace = Workspace.discover()
    diagnostics = Diagnostics()
    path = _located(word, workspace, diagnostics)
    if path is None:
        return UrdfFile("", diagnostics)
    # Once: it may be a pipe, as in `check_urdf <(xacro robot.xacro)`.
    data = read_data(path, diagnostics)
    if data is None:
        return UrdfFile("", diagnostics)
    tag = parse_xml(data, str(path), diagnostics)
    is_xacro = path.suffix == ".xacro" or (tag is not None and _has_xacro(tag))
    text: str | None
    if is_xacro and tag is not None:
        _say(f"'{path}' is a xacro file; it was expanded first")
        expanded = expand_xacro(
            path, mappings=mappings, workspace=workspace, diagnostics=diagnostics
        )
        text = None if expanded is None else expanded.text
        tag = None if expanded is None else expanded.tag(diagnostics)
    else:
        # What would fill the memory here would do so in urdfdom's reader too.
        is_too_much = any(item.code == "limits.elements" for item in diagnostics)
        text = None if is_too_much else data.decode("utf-8", errors="replace")
        tag = None if tag is None else placed(tag)
    if tag is not None:
        folder = path.resolve().parent
        read_urdf(tag, context=ReadContext(workspace, diagnostics, str(path), folder))
    return UrdfFile(text, diagnostics)


def robot_in(file: UrdfFile) -> Robot | None:
    """Return the robot that urdfdom sees, its remarks printed; None when it refuses the file."""
    robot = None
    if file.text is not None:
        # The programs read line by line and end every line, the last one too.
        verdict = urdfdom_verdict(file.text + "\n" if file.text else "")
        robot = verdict.robot
        for remark in verdict.remarks:
            print(remark, file=sys.stderr)
    if robot is None:
        print("ERROR: Model Parsing the xml failed", file=sys.stderr)
    return robot


def report_findings(file: UrdfFile) -> None:
    """Print our findings behind the program's own output."""
    sys.stdout.flush()
    render(file.diagnostics)


def _located(word: str, workspace: Workspace, diagnostics: Diagnostics) -> Path | None:
    if "://" not in word:
        path = Path(word)
        if exists(path) and not is_folder(path):
            return path
        reason = "is a folder" if is_folder(path) else "does not exist"
        diagnostics.report("load.not-found", f"'{word}' {reason}", SourceSpan(word))
        return None
    found = workspace.resolve(word)
    if found.path is None or not is_file(found.path):
        diagnostics.report("load.not-found", found.explain(word), SourceSpan(word))
        return None
    _say(f"'{word}' is '{found.path}'")
    return found.path


def _has_xacro(root: Tag) -> bool:
    return any(tag.name.startswith("xacro:") for tag in root.walk())


def _say(text: str) -> None:
    print(f"gazelle: {text}", file=sys.stderr)
