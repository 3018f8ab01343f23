"""The command line of ``gazelle convert``."""

from __future__ import annotations

import argparse
from pathlib import Path

from gazelle.cli.convert.sources import is_source_mjcf, located, read_source_world
from gazelle.cli.convert.targets import Target, as_sdformat, check_free, chosen_model, write
from gazelle.description.model import Model, World
from gazelle.description.sdformat_emulation import Release
from gazelle.description.writers import Beside, Converted, to_sdf, to_urdf
from gazelle.diagnostics import Diagnostics, render
from gazelle.workspace import Workspace

__all__ = ["main"]

_ENDINGS = {
    ".mjcf": "mjcf",
    ".sdf": "sdf",
    ".urdf": "urdf",
    ".world": "sdf",
    ".xml": "mjcf",
}
_FORMATS = ("urdf", "sdf", "mjcf")


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
    beside = Beside(
        target.folder, target.stem, workspace, options.package, relative=target.format != "urdf"
    )
    path = located(options.source, workspace)
    if target.format == "mjcf" and is_source_mjcf(path):
        parser.error(f"'{options.source}' is MJCF already")
    if target.format == "sdf" and not options.model and not is_source_mjcf(path):
        release = Release(int(options.sdformat))
        converted = as_sdformat(path, release, workspace, diagnostics, mappings)
        what = f"SDF as sdformat {release.value} makes it"
    else:
        world = read_source_world(options.source, path, workspace, diagnostics, mappings, beside)
        converted, what = _convert(world, target.format, options, diagnostics, beside)
    check_free(target, converted, force=options.force)
    write(target, converted)
    render(diagnostics)
    if target.path is not None:
        count = len(converted.files)
        company = f", {count} file{'s' * (count != 1)} beside it" if count else ""
        print(f"{target.path}: {what}{company}")
    return 1 if diagnostics.errors else 0


def _convert(
    world: World,
    format_: str,
    options: argparse.Namespace,
    diagnostics: Diagnostics,
    beside: Beside,
) -> tuple[Converted, str]:
    if format_ == "urdf":
        model = chosen_model(world, options.model, diagnostics)
        text = to_urdf(model, diagnostics=diagnostics, beside=beside)
        return text, f"URDF of '{model.name}', {_counts(model)}"
    if options.model:
        world = World(
            name=world.name,
            models=(chosen_model(world, options.model, diagnostics),),
            gravity_m_s2=world.gravity_m_s2,
            physics=world.physics,
            file=world.file,
        )
    shown = f"{len(world.models)} model{'s' * (len(world.models) != 1)}"
    if format_ == "mjcf":
        from gazelle.engine.mjcf import to_mjcf

        return to_mjcf(world, diagnostics=diagnostics, beside=beside), f"MJCF of {shown}"
    release = Release(int(options.sdformat))
    source = world.models[0] if len(world.models) == 1 else world
    text = to_sdf(source, diagnostics=diagnostics, beside=beside, release=release)
    return text, f"SDF {'.'.join(map(str, release.spec))} of {shown}"


def _counts(model: Model) -> str:
    links, joints = len(model.links), len(model.joints)
    return f"{links} link{'s' * (links != 1)}, {joints} joint{'s' * (joints != 1)}"


def _target(options: argparse.Namespace, parser: argparse.ArgumentParser) -> Target:
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
    return Target(path, format_)


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
