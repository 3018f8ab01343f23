"""What conversions become: which model, by whose words, into which file."""

from __future__ import annotations

import os
import re
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from gazelle.description.model import Model, World
from gazelle.description.sdformat_emulation import Release
from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.writers import Converted
from gazelle.description.xacro import expand_xacro
from gazelle.description.xml import parse_xml, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan, nearest_names
from gazelle.errors import GazelleError, NotFoundError, UserFileError
from gazelle.workspace import Workspace

__all__ = ["Target", "as_sdformat", "check_free", "chosen_model", "write"]

_COLOUR = re.compile(r"\x1b\[[0-9;]*m")


@dataclass(frozen=True, slots=True)
class Target:
    """Where a conversion goes.

    Attributes:
        path: the file; None for standard output.
        format: ``urdf``, ``sdf`` or ``mjcf``.
    """

    path: Path | None
    format: str

    @property
    def folder(self) -> Path | None:
        """The file's folder."""
        return None if self.path is None else self.path.parent

    @property
    def stem(self) -> str:
        """The file's name without its ending."""
        return "model" if self.path is None else self.path.stem


def chosen_model(world: World, name: str, diagnostics: Diagnostics) -> Model:
    """Return the model that is meant: the one named, the only one, or the only one that moves.

    Raises:
        NotFoundError: there is no model of the name.
        UserFileError: there are several that could be meant.
    """
    names = [model.name for model in world.models]
    if name:
        found = world.model(name)
        if found is None:
            hint = f"models there: {', '.join(names)}"
            raise NotFoundError("model", name, nearest=nearest_names(name, names), hint=hint)
        return found
    moving = [model for model in world.models if not model.static]
    candidates = moving if len(world.models) > 1 else list(world.models)
    if len(candidates) == 1:
        left = [item for item in names if item != candidates[0].name]
        if left:
            message = f"only '{candidates[0].name}' is written, without {', '.join(left)}"
            diagnostics.report("convert.left-out", message, world.span)
        return candidates[0]
    if not names:
        diagnostics.report("load.nothing", "there is no model in the file", world.span)
        raise UserFileError(tuple(diagnostics))
    message = f"there are {len(names)} models: {', '.join(names)}; a URDF is one robot"
    diagnostics.report("convert.several-models", message, world.span)
    raise UserFileError(tuple(diagnostics))


def as_sdformat(
    path: Path | None,
    release: Release,
    workspace: Workspace,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str],
) -> Converted:
    """Return a URDF, xacro or SDF file as the SDF that Gazebo's own library makes of it.

    Raises:
        UserFileError: the library refuses the file; holds what it says.
    """
    from gazelle.description.sdformat_emulation.gz_sdf import (
        read_document,
        read_document_file,
        to_text,
    )

    if path is None:
        diagnostics.report("load.not-found", "the source does not exist")
        raise UserFileError(tuple(diagnostics))

    def find(word: str) -> Path | None:
        return workspace.resolve(word).path

    text = _expanded(path, workspace, diagnostics, mappings)
    if text is None:
        document = read_document_file(str(path), release=release, find=find)
    else:
        document = read_document(text, release=release, file=str(path), find=find)
    span = SourceSpan(str(path))
    for line in dict.fromkeys([*map(str, document.errors), *document.console.lines]):
        said = " ".join(_COLOUR.sub("", line).split())
        message = f"sdformat {release.value} says: {said}"
        diagnostics.report("convert.sdformat", message, span)
    if document.root is None:
        message = f"sdformat {release.value} refuses '{path}'"
        diagnostics.report("load.nothing", message, span)
        raise UserFileError(tuple(diagnostics))
    _report_losses(path, text, document.root, release, diagnostics)
    return Converted(to_text(document.root, release), {})


def _report_losses(
    path: Path, text: str | None, made: SdfElement, release: Release, diagnostics: Diagnostics
) -> None:
    """Say what sdformat drops of a robot without a word.

    Raises:
        UserFileError: no link is left.
    """
    unheard = Diagnostics()
    robot = read_xml(path, unheard) if text is None else parse_xml(text, str(path), unheard)
    if robot is None or robot.name != "robot":
        return
    elements = list(made.walk())
    if robot.find("link") is not None and not any(item.name == "link" for item in elements):
        message = f"sdformat {release.value} leaves out every link of '{path}': the first link that"
        message += " has no <inertial> goes with all that hangs on it"
        diagnostics.report("convert.no-links", message, robot.span)
        raise UserFileError(tuple(diagnostics))
    if any(item.name == "mimic" for item in elements):
        return
    for joint in robot.find_all("joint"):
        mimic = joint.find("mimic")
        if mimic is not None:
            name, leader = joint.attributes.get("name", ""), mimic.attributes.get("joint", "")
            message = f"joint '{name}' follows '{leader}' no more: "
            message += f"SDF of sdformat {release.value} has no <mimic>"
            diagnostics.report("convert.left-out", message, mimic.span)


def _expanded(
    path: Path, workspace: Workspace, diagnostics: Diagnostics, mappings: Mapping[str, str]
) -> str | None:
    """Return a xacro file's expansion, None for a file that is none."""
    root = read_xml(path, Diagnostics()) if path.is_file() else None
    uses = root is not None and any(tag.name.startswith("xacro:") for tag in root.walk())
    if path.suffix != ".xacro" and not uses:
        return None
    expanded = expand_xacro(path, mappings=mappings, workspace=workspace, diagnostics=diagnostics)
    if expanded is None:
        raise UserFileError(tuple(diagnostics))
    return expanded.text


def check_free(target: Target, converted: Converted, *, force: bool) -> None:
    """Refuse to replace files that are there and differ.

    Raises:
        GazelleError: one is there.
    """
    if target.folder is None or force:
        return
    for name, data in converted.files.items():
        path = target.folder / name
        if path.exists() and path.read_bytes() != data:
            raise GazelleError(f"'{path}' exists and is another file; add -f to replace it")


def write(target: Target, converted: Converted) -> None:
    """Write text and company; every file is there as a whole or not at all.

    Raises:
        GazelleError: the disk refuses.
    """
    if target.path is None:
        sys.stdout.write(converted.text)
        return
    try:
        for name, data in converted.files.items():
            path = target.path.parent / name
            path.parent.mkdir(parents=True, exist_ok=True)
            _write_whole(path, data)
        _write_whole(target.path, converted.text.encode("utf-8"))
    except OSError as error:
        raise GazelleError(f"cannot write '{target.path}': {error.strerror}") from error


def _write_whole(path: Path, data: bytes) -> None:
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        # mkstemp makes files for the owner only.
        mask = os.umask(0)
        os.umask(mask)
        Path(name).chmod(0o666 & ~mask)
        Path(name).replace(path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
