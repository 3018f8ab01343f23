"""What the words of the command line mean: packages, files, launches."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from gazelle.diagnostics import nearest_names
from gazelle.doctor.file_kinds import looks_like
from gazelle.documents.files import is_file, is_folder
from gazelle.errors import GazelleError, NotFoundError
from gazelle.workspace import Package, Workspace

__all__ = ["Target", "find_target", "package_at"]

_SHOWN = 8


class Target(NamedTuple):
    """What is examined; one of the three is there.

    Attributes:
        name: as the user named it, for the report.
        files: files that are examined together; several only for launch files.
        folder: a folder that is no package, examined with everything in it.
        packages: packages, examined with everything in them.
    """

    name: str
    files: tuple[Path, ...] = ()
    folder: Path | None = None
    packages: tuple[Package, ...] = ()


def find_target(argv: Sequence[str], workspace: Workspace, cwd: Path) -> Target:
    """Return what the words mean: ``PKG``, ``FOLDER``, ``FILE``, ``PKG FILE``, nothing, a URI.

    Args:
        argv: of the command line, arguments (``name:=value``) taken out.
        workspace: where packages, models and worlds are.
        cwd: the current folder.

    Raises:
        NotFoundError: nothing has such a name; holds the nearest names there are.
        GazelleError: there is nothing in the current folder, or there are too many words.
    """
    if not argv:
        return _around(cwd, workspace)
    name = " ".join(argv)
    paths = tuple(cwd / Path(word).expanduser() for word in argv)
    if len(argv) > 1 and all(is_file(path) for path in paths):
        return Target(name, paths)
    if len(argv) == 2:
        return Target(name, (_file_in(workspace.package(argv[0]), argv[1]),))
    if len(argv) > 2:
        missing = next(path for path in paths if not is_file(path))
        raise NotFoundError("file", str(missing), hint="give one target, or files of one launch")
    return _single(argv[0], paths[0], workspace)


def package_at(folder: Path, workspace: Workspace) -> Package | None:
    """Return the package that a folder is or lies in, None when there is none."""
    place = folder.resolve()
    own = {item.path.resolve(): item for item in workspace.user_packages}
    return next((own[path] for path in (place, *place.parents) if path in own), None)


def _single(word: str, path: Path, workspace: Workspace) -> Target:
    if is_file(path):
        return Target(word, (path,))
    # A package's name wins over a folder of that name that is something else.
    if is_folder(path) and (word not in workspace.packages or "/" in word):
        return _folder(word, path, workspace)
    if word in workspace.packages:
        return Target(word, packages=(workspace.package(word),))
    if "://" in word or word.startswith("$("):
        found = workspace.resolve(word)
        if found.path is None:
            raise NotFoundError("file", word, searched=found.tried, nearest=found.nearest)
        return _single(word, found.path, workspace)
    model = workspace.model_dir(word) if "/" not in word else None
    if model is not None:
        return _folder(word, model, workspace)
    world = workspace.world_file(word)
    if world.path is not None:
        return Target(word, (world.path,))
    raise _not_found(word, path, workspace)


def _folder(word: str, path: Path, workspace: Workspace) -> Target:
    place = path.resolve()
    for file in ("model.config", "model.sdf"):
        if is_file(path / file):
            return Target(word, (path / file,))
    inside = [
        item
        for item in workspace.user_packages
        if place in (item.path.resolve(), *item.path.resolve().parents)
    ]
    if inside:
        return Target(word, packages=tuple(inside))
    return Target(word, folder=path)


def _around(cwd: Path, workspace: Workspace) -> Target:
    """Return the package of the current folder, or all packages of its workspace."""
    package = package_at(cwd, workspace)
    if package is not None:
        return Target(package.name, packages=(package,))
    own = workspace.user_packages
    around = (cwd.resolve(), *cwd.resolve().parents)
    here = tuple(
        item for item in own if any(path in item.path.resolve().parents for path in around[:1])
    )
    if here or own:
        return Target(str(cwd), packages=here or own)
    if any(looks_like(path) for path in cwd.iterdir() if is_file(path)):
        return Target(str(cwd), folder=cwd)
    raise GazelleError(
        f"'{cwd}' is no package, no workspace and holds no file that can be examined; name "
        "what to examine: gazelle doctor PACKAGE | FOLDER | FILE | PACKAGE FILE.launch"
    )


def _file_in(package: Package, name: str) -> Path:
    direct = package.path / name
    if is_file(direct):
        return direct
    found = sorted(package.path.rglob(Path(name).name))
    whole = [path for path in found if is_file(path) and str(path).endswith(f"/{name}")]
    if whole:
        return whole[0]
    existing = sorted({path.name for path in package.path.rglob("*") if looks_like(path)})
    shown = ", ".join(existing[:_SHOWN]) + (" …" if len(existing) > _SHOWN else "")
    raise NotFoundError(
        "file",
        name,
        searched=[str(package.path)],
        nearest=nearest_names(Path(name).name, existing),
        hint=f"files there: {shown or 'none'}",
    )


def _not_found(word: str, path: Path, workspace: Workspace) -> NotFoundError:
    around = path.parent if is_folder(path.parent) else Path.cwd()
    prefix = word.rpartition("/")[0]
    files = {
        f"{prefix}/{item.name}" if prefix else item.name
        for item in around.iterdir()
        if is_folder(item) or looks_like(item)
    }
    names = sorted({*files, *workspace.packages, *workspace.models})
    return NotFoundError(
        "package, file, model or world",
        word,
        searched=[str(around.absolute()), *workspace.package_places],
        nearest=nearest_names(word, names),
    )
