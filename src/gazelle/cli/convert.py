"""``gazelle convert SOURCE -o TARGET``: robots and worlds in other formats.

A source is any description that Gazelle reads, or one of MuJoCo's files.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from gazelle.description.loader import load_world
from gazelle.description.model import Model, World
from gazelle.description.sdformat_emulation import Release
from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.writers import Converted, OutputFiles, to_sdf, to_urdf
from gazelle.description.xacro import expand_xacro
from gazelle.description.xml import parse_xml, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan, nearest_names, render
from gazelle.errors import GazelleError, NotFoundError, UserFileError
from gazelle.workspace import Workspace

__all__ = [
    "main",
]

_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
_ENDINGS = {
    ".mjcf": "mjcf",
    ".sdf": "sdf",
    ".urdf": "urdf",
    ".world": "sdf",
    ".xml": "mjcf",
}
_FORMATS = ("urdf", "sdf", "mjcf")


@dataclass(frozen=True, slots=True)
class _Target:
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


def main(argv: list[str]) -> int:
    """Convert a description.

    Returns:
        0 when everything could be read; 1 when the source has errors; 2 for wrong usage.
    """
    mappings = dict(word.split(":=", 1) for word in argv if ":=" in word)
    parser = _parser()
    options = parser.parse_args([word for word in argv if ":=" not in word])
    target = _target(options, parser)
    diagnostics = Diagnostics()
    workspace = Workspace.discover()
    output_files = OutputFiles(
        target.folder, target.stem, workspace, options.package, relative=target.format != "urdf"
    )
    path = _located(options.source, workspace)
    if target.format == "mjcf" and _is_source_mjcf(path):
        parser.error(f"'{options.source}' is MJCF already")
    if target.format == "sdf" and not options.model and not _is_source_mjcf(path):
        release = Release(int(options.sdformat))
        converted = _as_sdformat(path, release, workspace, diagnostics, mappings)
        what = f"SDF as sdformat {release.value} makes it"
    else:
        world = _read_source_world(
            options.source, path, workspace, diagnostics, mappings, output_files
        )
        converted, what = _convert(world, target.format, options, diagnostics, output_files)
    _check_free(target, converted, force=options.force)
    _write(target, converted)
    render(diagnostics)
    if target.path is not None:
        count = len(converted.files)
        company = f", {count} file{'s' * (count != 1)} beside it" if count else ""
        print(f"{target.path}: {what}{company}")
    return 1 if diagnostics.errors else 0


def _located(word: str, workspace: Workspace) -> Path | None:
    """Return the file or folder that a path, URI or model's name means; None for none."""
    path = Path(word)
    if path.exists():
        return path
    found = workspace.resolve(word).path or workspace.world_file(word).path
    return found if found is not None else workspace.model_dir(word)


def _is_source_mjcf(path: Path | None) -> bool:
    """Tell whether a file is MuJoCo's."""
    if path is None or not path.is_file():
        return False
    # MuJoCo takes a tenth of a second to import, which other conversions need not wait for.
    if b"<mujoco" not in path.read_bytes():
        return False
    from gazelle.engine.mjcf import is_mjcf

    return is_mjcf(path)


def _read_source_world(
    word: str,
    path: Path | None,
    workspace: Workspace,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str],
    output_files: OutputFiles,
) -> World:
    """Read a source.

    Args:
        word: as it was given.
        path: where it is.
        workspace: finds packages, models and meshes.
        diagnostics: receives every finding.
        mappings: values of ``<xacro:arg>``.
        output_files: takes meshes that only MuJoCo can read.

    Raises:
        UserFileError: there is nothing to convert; holds all findings.
    """
    if path is not None and _is_source_mjcf(path):
        from gazelle.engine.mjcf import read_mjcf

        world = read_mjcf(path, diagnostics=diagnostics, output_files=output_files)
        if world is None:
            raise UserFileError(tuple(diagnostics))
        return world
    source = str(path) if path is not None else word
    return load_world(source, workspace=workspace, diagnostics=diagnostics, mappings=mappings)


def _chosen_model(world: World, name: str, diagnostics: Diagnostics) -> Model:
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


def _as_sdformat(
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
    from gazelle.description.sdformat_emulation.gz_sdf_command import (
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


def _check_free(target: _Target, converted: Converted, *, force: bool) -> None:
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


def _write(target: _Target, converted: Converted) -> None:
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


def _convert(
    world: World,
    format_: str,
    options: argparse.Namespace,
    diagnostics: Diagnostics,
    output_files: OutputFiles,
) -> tuple[Converted, str]:
    if format_ == "urdf":
        model = _chosen_model(world, options.model, diagnostics)
        text = to_urdf(model, diagnostics=diagnostics, output_files=output_files)
        return text, f"URDF of '{model.name}', {_counts(model)}"
    if options.model:
        world = World(
            name=world.name,
            models=(_chosen_model(world, options.model, diagnostics),),
            gravity_m_s2=world.gravity_m_s2,
            physics=world.physics,
            file=world.file,
        )
    shown = f"{len(world.models)} model{'s' * (len(world.models) != 1)}"
    if format_ == "mjcf":
        from gazelle.engine.mjcf import to_mjcf

        return to_mjcf(
            world, diagnostics=diagnostics, output_files=output_files
        ), f"MJCF of {shown}"
    release = Release(int(options.sdformat))
    source = world.models[0] if len(world.models) == 1 else world
    text = to_sdf(source, diagnostics=diagnostics, output_files=output_files, release=release)
    return text, f"SDF {'.'.join(map(str, release.spec))} of {shown}"


def _counts(model: Model) -> str:
    links, joints = len(model.links), len(model.joints)
    return f"{links} link{'s' * (links != 1)}, {joints} joint{'s' * (joints != 1)}"


def _target(options: argparse.Namespace, parser: argparse.ArgumentParser) -> _Target:
    path = None if options.output in (None, "-") else Path(options.output)
    format_ = options.to or (_ENDINGS.get(path.suffix.lower(), "") if path is not None else "")
    if not format_:
        known = ", ".join(sorted(_ENDINGS))
        where = f"the ending of '{path}' does not say the format" if path else "no format is given"
        parser.error(f"{where}; add --to urdf, --to sdf or --to mjcf (endings known: {known})")
    if options.package and format_ != "urdf":
        parser.error("--package is for URDF: other formats do not know ROS packages")
    if path is not None and path.is_dir():
        parser.error(f"'{path}' is a folder; name a file")
    if path is not None and path.exists() and not options.force:
        parser.error(f"'{path}' exists; add -f to replace it")
    if path is not None and not path.parent.is_dir():
        parser.error(f"there is no folder '{path.parent}'")
    return _Target(path, format_)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle convert",
        usage="gazelle convert SOURCE [-o TARGET] [options] [xacro_arg:=value …]",
        description="Write a robot or world in another format. What that cannot say is named.",
    )
    add = parser.add_argument
    add("source", metavar="SOURCE", help="URDF, xacro, SDF, world or MJCF file, URI or model")
    add("-o", "--output", metavar="TARGET", help="file to write; - or nothing: standard output")
    add("--to", choices=_FORMATS, help="format, where the target's ending does not say it")
    add("-f", "--force", action="store_true", help="replace files that exist")
    add("--model", metavar="NAME", default="", help="the one model of a file that is meant")
    add("--package", metavar="NAME", default="", help="URDF: name files package://NAME/…")
    add(
        "--sdformat",
        choices=("9", "12"),
        default="12",
        help="SDF as Gazebo 11 (9) or Fortress (12, the default) reads it",
    )
    return parser
