"""What ``gazelle view`` is to show: a file, a package's robot, a model or a world by its name."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from gazelle.description.loader import load_models, load_world
from gazelle.description.model import World
from gazelle.diagnostics import Diagnostics, nearest_names
from gazelle.errors import GazelleError, NotFoundError
from gazelle.workspace import Package, Workspace

__all__ = ["Viewed", "find_viewed", "robot_files"]

_ROBOT_FOLDERS = ("urdf", "robots", "robot", "xacro", "models", "sdf", "worlds", ".")
_ROBOT_SUFFIXES = (".urdf", ".urdf.xacro", ".xacro", ".sdf", ".world")
_PIECES = ("macro", "common", "material", "gazebo", "properties", "inertial", "plugin", "sensor")
"""Words in the names of xacro files that other files include."""


class Viewed(NamedTuple):
    """What is shown and a word for its picture's name."""

    world: World
    name: str


def find_viewed(
    words: list[str],
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str] | None = None,
) -> Viewed:
    """Read what one or two words name: ``FILE``, ``PACKAGE``, ``PACKAGE FILE``, ``MODEL``, a URI.

    Raises:
        GazelleError: the package has several robots, and none of them its name.
        NotFoundError: nothing has such a name; holds the nearest names there are.
        UserFileError: the file is no usable description.
    """
    if len(words) == 2:
        path = _file_in(workspace.package(words[0]), words[1])
        return Viewed(load_world(path, workspace=workspace, diagnostics=diagnostics,
                                 mappings=mappings), _stem(path))  # fmt: skip
    word = words[0]
    path = Path(word)
    if path.is_dir() and not _is_model(path):
        word = _package_at(path, workspace) or word
        return _named(word, workspace, diagnostics, mappings)
    if "://" not in word and not path.exists() and not path.suffix and "/" not in word:
        return _named(word, workspace, diagnostics, mappings)
    if "://" not in word and not path.exists() and workspace.world_file(word).path is None:
        raise _not_found(word, workspace)
    world = load_world(word, workspace=workspace, diagnostics=diagnostics, mappings=mappings)
    return Viewed(world, _stem(Path(word.rstrip("/"))))


def robot_files(package: Package) -> tuple[Path, ...]:
    """Return the descriptions in a package that stand for themselves, likeliest first."""
    found: dict[Path, None] = {}
    for folder in _ROBOT_FOLDERS:
        place = package.path / folder
        if not place.is_dir():
            continue
        files = sorted(place.iterdir() if folder == "." else place.rglob("*"))
        for suffix in _ROBOT_SUFFIXES:
            found |= {path: None for path in files if path.name.endswith(suffix)}
    whole = [path for path in found if not _is_piece(path)]
    robots = [path for path in whole if path.suffix != ".world"]
    return tuple(robots or whole or found)


def _is_piece(path: Path) -> bool:
    return path.suffix == ".xacro" and any(word in path.name.lower() for word in _PIECES)


def _named(
    name: str,
    workspace: Workspace,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str] | None,
) -> Viewed:
    folder = workspace.model_dir(name)
    if name in workspace.packages:
        path = _robot_of(workspace.package(name))
        if path is not None:
            world = load_world(
                path, workspace=workspace, diagnostics=diagnostics, mappings=mappings
            )
            return Viewed(world, name)
    if folder is not None:
        models = load_models(folder, workspace=workspace, diagnostics=diagnostics)
        diagnostics.raise_if_errors()
        return Viewed(World(models=models), name)
    if workspace.world_file(name).path is not None:
        return Viewed(load_world(name, workspace=workspace, diagnostics=diagnostics), name)
    raise _not_found(name, workspace)


def _is_model(folder: Path) -> bool:
    return (folder / "model.config").is_file() or (folder / "model.sdf").is_file()


def _package_at(folder: Path, workspace: Workspace) -> str:
    """Return the name of the package whose folder it is, empty when it is none's."""
    place = folder.resolve()
    found = (item.name for item in workspace.packages.values() if item.path.resolve() == place)
    return next(found, "")


def _robot_of(package: Package) -> Path | None:
    """Return the package's one description, or the one that carries its name."""
    files = robot_files(package)
    plain = package.name.removesuffix("_description").removesuffix("_gazebo")
    same = [path for path in files if _stem(path) in {plain, package.name}]
    if len(files) <= 1 or same:
        return next(iter(same or files), None)
    names = [str(path.relative_to(package.path)) for path in files]
    raise GazelleError(
        f"package '{package.name}' has several robots; name one: "
        f"gazelle view {package.name} {files[0].name}\n  files there: {', '.join(names)}"
    )


def _file_in(package: Package, name: str) -> Path:
    direct = package.path / name
    found = [direct] if direct.is_file() else sorted(package.path.rglob(Path(name).name))
    if found:
        return found[0]
    names = [path.name for path in robot_files(package)]
    raise NotFoundError(
        "robot file",
        name,
        searched=[str(package.path)],
        nearest=nearest_names(name, names),
        hint=f"files there: {', '.join(names) or 'none'}",
    )


def _not_found(word: str, workspace: Workspace) -> NotFoundError:
    path = Path(word)
    around = path.parent if path.parent.is_dir() else Path()
    files = {
        str(item if path.is_absolute() else path.parent / item.name)
        for item in around.iterdir()
        if item.name.endswith(_ROBOT_SUFFIXES)
    }
    names = {*files, *workspace.packages, *workspace.models}
    return NotFoundError(
        "robot, model or world",
        word,
        searched=[str(around.absolute()), "the packages and models known (gazelle rospack list)"],
        nearest=nearest_names(word, sorted(names)),
    )


def _stem(path: Path) -> str:
    if path.name in {"model.sdf", "model.config"}:
        return path.absolute().parent.name
    return path.name.split(".")[0] or "view"
