"""Which robot a package's parameter files are for."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import Any

from gazelle.description.loader import load_models
from gazelle.description.model import Model
from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.packages.dependency_checks import uses
from gazelle.doctor.packages.source import SourcePackage
from gazelle.doctor.parameters.document import plain, read_document
from gazelle.documents.files import is_file
from gazelle.workspace import Package, Workspace

__all__ = ["expanded_text", "robots_for", "whole_robots"]

_MAX_FILES = 24
_HEAD = 20_000
_ENDINGS = (".urdf", ".urdf.xacro", ".xacro", ".urdf.xml")
# Half of the names may be wrong and it still is the robot that was meant.
_MIN_IN_COMMON = 0.5


def robots_for(
    package: Package, names: Collection[str], *, ros_version: int, workspace: Workspace
) -> tuple[Model, ...]:
    """Return the robots that have most of these joints; none when none has at least half of them.

    Looked at are the package's own descriptions, the one that its ``.setup_assistant`` names, and
    those of the packages it uses or depends on.

    Args:
        package: with the parameter files.
        names: joints that the files name.
        ros_version: 1 prefers robots with transmissions, 2 those with ``<ros2_control>``.
        workspace: finds the other packages.
    """
    found: dict[tuple[float, bool], list[Model]] = {}
    for path, mappings in islice(_candidates(package, workspace), _MAX_FILES):
        for model in _models(path, tuple(mappings.items()), workspace):
            joints = {joint.name for joint in model.joints}
            share = len(joints & set(names)) / len(names) if names else 0.0
            has = bool(model.ros2_controls if ros_version == 2 else model.transmissions)
            found.setdefault((share, has), []).append(model)
    best = max(found, default=(0.0, False))
    return tuple(found[best]) if best[0] >= _MIN_IN_COMMON else ()


def whole_robots(source: SourcePackage, workspace: Workspace) -> Iterator[tuple[Path, str]]:
    """Yield the package's descriptions that are robots by themselves, with their expanded texts."""
    for name in (item for item in source.files if item.endswith(_ENDINGS)):
        if "<robot" in source.text(name)[:_HEAD]:
            text = source.text(name)
            if name.endswith(".xacro"):
                text = expanded_text(source.folder / name, workspace)
            if "<link" in text:
                yield source.folder / name, text


def expanded_text(path: Path, workspace: Workspace) -> str:
    """Return what xacro makes of a file without arguments, empty when it needs some."""
    found = expand_xacro(path, workspace=workspace, diagnostics=Diagnostics())
    return "" if found is None else found.text


def _candidates(package: Package, workspace: Workspace) -> Iterator[tuple[Path, Mapping[str, str]]]:
    seen: set[Path] = set()
    for path, mappings in (*_of_assistant(package, workspace), *_of_packages(package, workspace)):
        if path not in seen:
            seen.add(path)
            yield path, mappings


def _of_packages(
    package: Package, workspace: Workspace
) -> Iterator[tuple[Path, Mapping[str, str]]]:
    names = [package.name, *(use.package for use in uses(SourcePackage(package)))]
    for name in dict.fromkeys([*names, *package.depends]):
        found = workspace.packages.get(name)
        if found is None or found.is_builtin:
            continue
        files = [item for item in SourcePackage(found).files if item.endswith(_ENDINGS)]
        for item in sorted(files, key=_importance):
            if "<robot" in _head(found.path / item):
                yield found.path / item, {}


def _importance(name: str) -> tuple[bool, bool, int]:
    """Sort whole robots before pieces: robot.urdf.xacro, then robot.urdf, then others."""
    is_plain_xacro = name.endswith(".xacro") and not name.endswith(".urdf.xacro")
    return is_plain_xacro, not name.endswith(".xacro"), name.count("/")


def _head(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")[:_HEAD]
    except OSError:
        return ""


def _of_assistant(
    package: Package, workspace: Workspace
) -> Iterator[tuple[Path, Mapping[str, str]]]:
    path = package.path / ".setup_assistant"
    document = read_document(path, Diagnostics()) if path.is_file() else None
    tree: Any = plain(document.root) if document is not None else {}
    inner = tree.get("moveit_setup_assistant_config")
    urdf = inner.get("URDF", inner.get("urdf")) if isinstance(inner, dict) else None
    if not isinstance(urdf, dict):
        return
    owner = workspace.packages.get(str(urdf.get("package")))
    file = owner.path / str(urdf.get("relative_path")) if owner is not None else None
    if file is not None and is_file(file):
        words = str(urdf.get("xacro_args") or "").split()
        pairs = (word.partition(":=") for word in words if ":=" in word)
        yield file, {name: value for name, _, value in pairs}


@lru_cache(maxsize=32)
def _models(
    path: Path, mappings: tuple[tuple[str, str], ...], workspace: Workspace
) -> tuple[Model, ...]:
    """Read a description; what is wrong with it is told where it is examined itself."""
    found = load_models(
        path,
        workspace=workspace,
        diagnostics=Diagnostics(),
        mappings=dict(mappings),
        inserts=False,
    )
    return tuple(model for model in found if model.source_format == "urdf")
