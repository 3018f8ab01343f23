"""``robot_file.*``: shows a robot, model or world of files that were dropped on the page."""

from __future__ import annotations

import re
from collections.abc import Iterable
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, TypedDict

from gazelle.diagnostics import Diagnostic, Diagnostics, Severity, SourceSpan, grouped
from gazelle.diagnostics.launch_journal import Told
from gazelle.diagnostics.source_lines import SourceLines, excerpt
from gazelle.errors import GazelleError, UserFileError
from gazelle.studio.errors import StudioError
from gazelle.studio.launches.findings import LaunchFinding, finding_values
from gazelle.studio.lazy_parts import closed_with
from gazelle.studio.request_params import Params
from gazelle.studio.robot_files.dropped_files import DroppedFiles
from gazelle.studio.routing import Method
from gazelle.studio.scenes.assets import Assets
from gazelle.studio.scenes.shapes import page_scene
from gazelle.studio.world.streams import PageScene
from gazelle.workspace import Workspace
from gazelle.workspace.robot_files import ROBOT_SUFFIXES, robot_files

if TYPE_CHECKING:
    from gazelle.description.model import World

__all__ = ["METHODS", "RobotFile", "RobotFiles", "robot_file_parts"]

_URI = re.compile(r"package://(?P<package>[\w.-]+)/(?P<rest>[^\"'<>\s]+)")
_FIND = re.compile(r"\$\(find (?P<package>[\w.-]+)\)/(?P<rest>[^\"'<>\s$]+)")
_MOST_LISTED = 60
_MOST_TEXT = 4 << 20
_MANIFEST = """<package format="2"><name>{name}</name><version>0.0.0</version>
<description>what was dropped</description><maintainer email="a@b.c">x</maintainer>
<license>unknown</license></package>
"""


class RobotFile(TypedDict):
    """A description that was dropped.

    Attributes:
        file: the one that is shown; its path below what was dropped.
        files: all that can be shown.
        scene: null where it cannot be read.
        counts: of links, joints and the like, in words.
    """

    file: str
    files: list[str]
    scene: PageScene | None
    findings: list[LaunchFinding]
    counts: str


@dataclass(frozen=True)
class RobotFiles:
    """What dropped files are read with.

    Attributes:
        dropped: the files.
        assets: keeps meshes for pages.
    """

    dropped: DroppedFiles
    assets: Assets


def robot_file_parts(assets: Assets, ending: ExitStack) -> RobotFiles:
    """Return the parts that end with others."""
    return RobotFiles(closed_with(ending, DroppedFiles()), assets)


def _begin(robots: RobotFiles, params: Params) -> str:
    """``robot_file.begin``: the name of a new set of files."""
    return robots.dropped.begin()


def _put(robots: RobotFiles, params: Params) -> None:
    """``robot_file.put``: a file of a set, or a piece of it."""
    robots.dropped.put(
        params.text("set"),
        params.text("path"),
        params.text("base64"),
        is_more=params.flag("more", False),
    )


def _read(robots: RobotFiles, params: Params) -> RobotFile:
    """``robot_file.read``: one of a set's descriptions as a scene, with what is wrong in it."""
    folder = robots.dropped.folder(params.text("set"))
    files = _descriptions(folder)
    if not files:
        endings = ", ".join(ROBOT_SUFFIXES)
        raise StudioError(
            "there is no robot among these files",
            hint=f"drop a file that ends in one of {endings}, its folder or a .zip of that",
        )
    names = [path.relative_to(folder).as_posix() for path in files]
    name = params.text("file", names[0])
    if name not in names:
        raise StudioError(f"there is no '{name}' among these files", known=names)
    return _shown(folder, name, names[:_MOST_LISTED], robots.assets)


METHODS: dict[str, Method[RobotFiles]] = {
    "robot_file.begin": _begin,
    "robot_file.put": _put,
    "robot_file.read": _read,
}


def _descriptions(folder: Path) -> list[Path]:
    """Return the descriptions below a folder: those of its packages first, by their likelihood."""
    roots = [path.parent for path in sorted(folder.rglob("package.xml"))] or [folder]
    found = dict.fromkeys(path for root in roots for path in robot_files(root))
    others = sorted(folder.rglob("*"), key=lambda path: (len(path.parts), path))
    for suffix in ROBOT_SUFFIXES:
        found |= {path: None for path in others if path.name.endswith(suffix)}
    return [path for path in found if path.is_file()]


def _shown(folder: Path, name: str, names: list[str], assets: Assets) -> RobotFile:
    # Readers of descriptions take a third of the server's start; few pages wait for them.
    from gazelle.description.loader import load_world
    from gazelle.sensors.scene_json import world_value

    path, found = folder / name, Diagnostics()
    _name_packages(path, folder)
    world: World | None = None
    problems: Iterable[Diagnostic] = ()
    try:
        workspace = Workspace.discover(cwd=folder, extra=[folder])
        world = load_world(path, workspace=workspace, diagnostics=found)
    except UserFileError as error:
        problems = error.diagnostics
    except GazelleError as error:
        message, _, fix = str(error).partition("\n  fix: ")
        problems = [Diagnostic("", Severity.ERROR, message, SourceSpan(str(path)), fix)]
    for each in problems:
        found.add(each)
    lines = SourceLines()
    told = [
        Told(_as_dropped(item, folder), excerpt(item.span, lines) if item.span else None)
        for item in grouped(found)
    ]
    return {
        "file": name,
        "files": names,
        "scene": None if world is None else page_scene(world_value(world), assets),
        "findings": finding_values(told),
        "counts": "" if world is None else _counts(world),
    }


def _counts(world: World) -> str:
    links = sum(len(model.links) for model in world.models)
    joints = sum(len(model.joints) for model in world.models)
    sensors = sum(len(link.sensors) for model in world.models for link in model.links)
    parts = [(len(world.models), "model"), (links, "link"), (joints, "joint"), (sensors, "sensor")]
    return ", ".join(f"{count} {word}{'' if count == 1 else 's'}" for count, word in parts)


def _name_packages(path: Path, folder: Path) -> None:
    """Let folders be the packages that files name, where what was dropped has no manifest.

    Who drops a robot's folders alone drops ``urdf`` and ``meshes`` without the ``package.xml``
    above them.
    """
    if next(folder.rglob("package.xml"), None) is not None:
        return
    named = {
        (found["package"], found["rest"])
        for text in _texts(path, folder)
        for pattern in (_URI, _FIND)
        for found in pattern.finditer(text)
    }
    folders = [folder, *(each for each in sorted(folder.rglob("*")) if each.is_dir())]
    made: set[str] = set()
    for package, rest in sorted(named):
        if package in made:
            continue
        for each in folders:
            manifest = each / "package.xml"
            if not manifest.exists() and (each / rest).is_file():
                manifest.write_text(_MANIFEST.format(name=package), encoding="utf-8")
                made.add(package)
                break


def _texts(path: Path, folder: Path) -> list[str]:
    others = [each for each in folder.rglob("*.xacro") if each != path]
    files = [each for each in (path, *others) if each.stat().st_size < _MOST_TEXT]
    return [each.read_text(encoding="utf-8", errors="replace") for each in files]


def _as_dropped(item: Diagnostic, folder: Path) -> Diagnostic:
    """Name files as the person has them, not as Studio keeps them."""
    prefix = f"{folder}/"

    def own(span: SourceSpan) -> SourceSpan:
        via = tuple(own(each) for each in span.via)
        return replace(span, file=span.file.replace(prefix, ""), via=via)

    return replace(
        item,
        message=item.message.replace(prefix, ""),
        fix=item.fix.replace(prefix, ""),
        span=own(item.span) if item.span else None,
    )
