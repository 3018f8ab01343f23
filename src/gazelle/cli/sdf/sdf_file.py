"""What ``gz sdf`` and ``ign sdf`` share: reading, printing to the terminal, our own findings."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from pathlib import Path

from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader import read_sdf
from gazelle.description.sdformat_emulation.gz_sdf_command import Document, read_document_file
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.source_maps import placed
from gazelle.description.urdf_reader import read_urdf
from gazelle.description.xml import read_xml
from gazelle.diagnostics import Diagnostics, render
from gazelle.documents.files import exists
from gazelle.workspace import Workspace

__all__ = ["QUIET", "read_for", "report_findings", "say", "take_quiet"]

QUIET = "--no-findings"


def take_quiet(argv: list[str]) -> tuple[list[str], bool]:
    """Return a command's words without our own option, and whether it was given."""
    return [word for word in argv if word != QUIET], QUIET in argv


def read_for(word: str, release: Release) -> Document:
    """Read a file; what it includes is looked for in the workspace."""
    workspace = Workspace.discover()
    folder = Path(word).resolve().parent

    def find(uri: str) -> Path | None:
        return workspace.resolve(uri, base_dir=folder).path or _on_sdf_path(uri)

    return read_document_file(word, release=release, find=find)


def _on_sdf_path(name: str) -> Path | None:
    """Return what a bare name means in the folders of ``SDF_PATH``, None when it is nowhere."""
    if "://" in name:
        return None
    folders = [one for one in os.environ.get("SDF_PATH", "").split(os.pathsep) if one]
    return next((path for one in folders if exists(path := Path(one) / name)), None)


def say(lines: Iterable[object]) -> None:
    """Print lines where the real programs print what goes wrong."""
    sys.stdout.flush()
    for line in lines:
        print(line, file=sys.stderr)


def report_findings(word: str) -> None:
    """Print what our own readers find in a file, behind the program's output."""
    path = Path(word)
    if not path.is_file():
        return
    diagnostics = Diagnostics()
    tag = read_xml(path, diagnostics)
    if tag is not None:
        base = path.resolve()
        context = ReadContext(
            Workspace.discover(), diagnostics, str(path), base.parent, include_chain=(base,)
        )
        if tag.name == "robot":
            read_urdf(placed(tag), context=context)
        else:
            read_sdf(tag, context=context)
    sys.stdout.flush()
    render(diagnostics)
