"""URIs to paths, with every place tried and the nearest names when there is nothing."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import unquote

from gazelle.diagnostics import nearest_names
from gazelle.documents.files import is_file, is_folder
from gazelle.workspace.environment_paths import BUILTIN
from gazelle.workspace.file_lookup import Resolved, locate, nearest_below, nearest_packages
from gazelle.workspace.gazebo_models import (
    folded,
    folders_around,
    fuel_model,
    is_model_folder,
    original_models,
    original_worlds,
)

if TYPE_CHECKING:
    from gazelle.workspace.workspace import Workspace

__all__ = ["resolve", "resolve_world"]

_SCHEME = re.compile(r"([A-Za-z][A-Za-z0-9+.-]+)://(.*)|(file):(.*)", re.DOTALL)
_FIND = re.compile(r"\$\(find(?:-pkg-share)?\s+([^)\s]+)\s*\)/?(.*)", re.DOTALL)
_FUEL = re.compile(r"[^/]+/(?:[0-9.]+/)?([^/]+)/(models|worlds)/([^/]+)/?(.*)", re.DOTALL)
_VERSION = re.compile(r"/(?:tip|\d+)/?$|/$")


def resolve(workspace: Workspace, uri: str, base_dir: Path | None) -> Resolved:
    """Find what a URI means; see `Workspace.resolve`."""
    written = uri.strip()
    text = written.replace("\\", "/") if "\\" in written and os.sep == "/" else written
    result = _by_scheme(workspace, text, base_dir)
    if text != written and result.path is not None:
        note = "'\\' was read as '/'"
        note = f"{note}; {result.note}" if result.note else note
        return replace(result, note=note)
    return result


def resolve_world(workspace: Workspace, name: str, base_dir: Path | None) -> Resolved:
    """Find a world file; see `Workspace.world_file`."""
    if "://" in name or name.startswith("$("):
        return resolve(workspace, name, base_dir)
    bases = [] if base_dir is None else [base_dir]
    bases += [Path.cwd(), *workspace.resource_folders]
    names = [name]
    if not Path(name).suffix:
        names += [f"{name}.world", f"{name}.sdf"]
    names += [f"worlds/{item}" for item in names if "/" not in item]
    tried: list[str] = []
    for item in names:
        for base in bases:
            path = base / Path(item).expanduser()
            if is_file(path):
                return Resolved(path, tuple(dict.fromkeys([*tried, str(path)])))
            tried.append(str(path))
    worlds = {
        path.name for base in bases for path in sorted((base / "worlds").glob("*")) if is_file(path)
    }
    original = original_worlds().get(Path(name).name)
    if original is not None and not original.is_here:
        return Resolved(None, tuple(dict.fromkeys(tried)), note=original.advice)
    return Resolved(
        None, tuple(dict.fromkeys(tried)), nearest_names(Path(name).name, sorted(worlds))
    )


def _by_scheme(workspace: Workspace, uri: str, base_dir: Path | None) -> Resolved:
    found = _FIND.fullmatch(uri)
    if found:
        return _in_package(workspace, found.group(1), found.group(2))
    matched = _SCHEME.fullmatch(uri)
    if matched is None:
        return _plain(workspace, uri, base_dir)
    scheme, rest = (matched.group(1) or "file").lower(), matched.group(2) or matched.group(4) or ""
    if scheme == "file":
        return _file(workspace, rest, base_dir)
    if scheme == "package":
        name, _, inside = _unquoted(rest).lstrip("/").partition("/")
        return _in_package(workspace, name, inside)
    if scheme == "model":
        name, _, inside = _unquoted(rest).lstrip("/").partition("/")
        return _in_model(workspace, name, inside, base_dir)
    if scheme in {"http", "https"}:
        return _in_fuel_cache(workspace, _unquoted(rest))
    schemes = "package://, model://, file://"
    return Resolved(None, note=f"the scheme '{scheme}://' is not known; known are {schemes}")


def _unquoted(text: str) -> str:
    return unquote(text) if "%" in text else text


def _in_package(workspace: Workspace, name: str, inside: str) -> Resolved:
    package = workspace.packages.get(name)
    if package is None:
        return Resolved(
            None,
            workspace.package_places,
            nearest_packages(name, workspace.packages),
            f"there is no package '{name}'",
        )
    path, note = locate(package.path, inside)
    tried = (str(package.path / inside),)
    if path is not None:
        return Resolved(path, tried, note=note)
    near = tuple(f"package://{name}/{item}" for item in nearest_below(package.path, inside))
    note = "; ".join(filter(None, (f"package '{name}' has no '{inside}'", package.note_on_files)))
    return Resolved(None, tried, near, note)


def _in_model(workspace: Workspace, name: str, inside: str, base_dir: Path | None) -> Resolved:
    tried: list[str] = []
    for folder in _model_candidates(workspace, name):
        tried.append(str(folder / inside) if inside else str(folder))
        path, note = locate(folder, inside)
        if path is not None and (inside or is_folder(path)):
            return Resolved(path, tuple(tried), note=note)
    return (
        _off_the_path(workspace, name, inside, base_dir)
        or _stand_in(name, inside, tried)
        or _case_differs(workspace, name, inside, tried)
        or _no_model(workspace, name, inside, tried, base_dir)
    )


def _model_candidates(workspace: Workspace, name: str) -> Iterable[Path]:
    for folder in workspace.model_folders:
        if not _is_stand_in(folder / name):
            yield folder / name
    cached = workspace.models.get(name)
    if cached is not None and not _is_stand_in(cached):
        yield cached
    # gazebo_ros puts the parents of packages on Gazebo's model path, so that URDFs' package://
    # addresses work as model:// ones.
    package = workspace.packages.get(name)
    if package is not None:
        yield package.path


def _is_stand_in(folder: Path) -> bool:
    """Tell whether shapes of ours stand for a model that the user may have elsewhere."""
    if folder.parent != BUILTIN / "models":
        return False
    original = original_models().get(folder.name)
    return original is not None and original.is_here and not original.is_alike


def _stand_in(name: str, inside: str, tried: list[str]) -> Resolved | None:
    folder = BUILTIN / "models" / name
    path, _note = locate(folder, inside) if _is_stand_in(folder) else (None, "")
    if path is None:
        return None
    note = f"plain shapes of Gazelle's own stand in for Gazebo's model '{name}'"
    return Resolved(path, tuple(tried), note=note, is_stand_in=True)


def _off_the_path(
    workspace: Workspace, name: str, inside: str, base_dir: Path | None
) -> Resolved | None:
    folder = _folder_off_the_path(workspace, name, base_dir)
    path, note = (None, "") if folder is None else locate(folder, inside)
    if folder is None or path is None:
        return None
    text = f"found in '{folder.parent}', which no GAZEBO_MODEL_PATH names"
    return Resolved(path, (str(path),), note=f"{text}; {note}" if note else text, is_off_path=True)


def _folder_off_the_path(workspace: Workspace, name: str, base_dir: Path | None) -> Path | None:
    """Look where models lie in practice although nothing names the folder.

    Packages leave it to the user's shell or to a launch file to put their ``models`` folder
    into ``GAZEBO_MODEL_PATH``.
    """
    models = (package.path / "models" for package in workspace.user_packages)
    folders = (*folders_around(base_dir), *models)
    return next((path / name for path in folders if is_model_folder(path / name)), None)


def _case_differs(
    workspace: Workspace, name: str, inside: str, tried: list[str]
) -> Resolved | None:
    same = [item for item in workspace.models if folded(item) == folded(name)]
    for item in same:
        path, note = locate(workspace.models[item], inside)
        if path is not None and item != name:
            what = "upper and lower case differ"
            if item.casefold() != name.casefold():
                what = "the spelling differs"
            text = f"{what}: the model is '{item}', written was '{name}'"
            right = f"model://{item}/{inside}".rstrip("/") if not note else ""
            text = f"{text}; {note}" if note else text
            return Resolved(path, tuple(tried), note=text, right=right)
    return None


def _no_model(
    workspace: Workspace, name: str, inside: str, tried: list[str], base_dir: Path | None
) -> Resolved:
    places = [*tried, *(f"{root} (Fuel cache)" for root in workspace.fuel_folders)]
    home = (
        workspace.models.get(name)
        or getattr(workspace.packages.get(name), "path", None)
        or _folder_off_the_path(workspace, name, base_dir)
    )
    if home is not None and _is_stand_in(home):
        return Resolved(None, tuple(places), note=original_models()[home.name].advice_for(inside))
    if home is not None:
        near = tuple(f"model://{name}/{item}" for item in nearest_below(home, inside))
        return Resolved(None, tuple(places), near, f"model '{name}' has no '{inside}'")
    near = tuple(f"model://{item}" for item in nearest_names(name, workspace.models))
    return Resolved(None, tuple(places), near, _missing_model(name))


def _missing_model(name: str) -> str:
    original = original_models().get(folded(name))
    if original is not None and not original.is_here:
        return original.advice
    return (
        f"there is no model '{name}'; name the folder it lies in in GAZEBO_MODEL_PATH "
        "(nothing is downloaded)"
    )


def _in_fuel_cache(workspace: Workspace, rest: str) -> Resolved:
    """Find what an address of a model server means: in the caches, then a local model's name."""
    matched = _FUEL.fullmatch(rest)
    tried = tuple(f"{root} (Fuel cache)" for root in workspace.fuel_folders)
    if matched is None:
        name = _VERSION.sub("", rest).rpartition("/")[2]
        return _local_twin(workspace, name, tried) or Resolved(
            None, tried, note="nothing is downloaded; use a local path"
        )
    owner, kind, name, inside = matched.groups()
    inside = re.sub(r"^(?:tip|\d+)(?:/files)?(?:/|$)", "", inside)
    if kind == "worlds":
        note = f"world '{name}' of {owner} lies on a server and nothing is downloaded: "
        return Resolved(None, (), note=f"{note}give the path of a local file")
    for root in workspace.fuel_folders:
        folder = fuel_model(root, owner, name)
        if folder is not None:
            path, note = locate(folder, inside)
            if path is not None:
                return Resolved(path, (str(folder / inside),), note=note)
    twin = None if inside else _local_twin(workspace, name, tried)
    if twin is not None:
        return twin
    note = (
        f"model '{name}' of {owner} is in no local cache and nothing is downloaded: put it into "
        f"a folder '{folded(name)}' of GAZEBO_MODEL_PATH or GZ_SIM_RESOURCE_PATH"
    )
    return Resolved(None, tried, nearest_names(folded(name), workspace.models), note)


def _local_twin(workspace: Workspace, name: str, tried: tuple[str, ...]) -> Resolved | None:
    """Find a model here by the name a server has it under; spaces may be underlines."""
    same = [item for item in workspace.models if folded(item) == folded(name)]
    folder = workspace.model_dir(name if name in same or not same else same[0])
    if folder is None:
        return None
    if _is_stand_in(folder):
        note = f"plain shapes of Gazelle's own stand in for Fuel's model '{name}'"
    elif folder.parent == BUILTIN / "models":
        note = ""
    else:
        note = f"the local model '{folder}' stands in for Fuel's model '{name}'"
    return Resolved(folder, tried, note=note, is_stand_in=bool(note))


def _file(workspace: Workspace, rest: str, base_dir: Path | None) -> Resolved:
    text = _unquoted(rest)
    if re.match(r"/?[A-Za-z]:/", text):
        return _plain(workspace, text.lstrip("/"), base_dir)
    if text.startswith("localhost/"):
        text = text.removeprefix("localhost")
    return _plain(workspace, text, base_dir)


def _plain(workspace: Workspace, text: str, base_dir: Path | None) -> Resolved:
    path = Path(text).expanduser() if text.startswith("~") else Path(text)
    if path.is_absolute():
        bases, relative = [Path(path.anchor)], str(path.relative_to(path.anchor))
    else:
        bases = [] if base_dir is None else [base_dir]
        bases += [Path.cwd(), *workspace.resource_folders]
        relative = text
    tried: list[str] = []
    for base in dict.fromkeys(bases):
        tried.append(str(base / relative))
        found, note = locate(base, relative)
        if found is not None:
            return Resolved(found, tuple(tried), note=note)
    near = next(filter(None, (nearest_below(base, relative) for base in bases)), ())
    return Resolved(None, tuple(tried), near)
