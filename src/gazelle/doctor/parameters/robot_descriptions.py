"""Robots that a package's parameter files are for, and their texts as parameters."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import Any

from gazelle.description.loader import load_models
from gazelle.description.model import Model
from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.packages.dependency_checks import uses
from gazelle.doctor.packages.source import SourcePackage
from gazelle.doctor.parameters.parameter_file import plain, read_document
from gazelle.documents.files import is_file
from gazelle.workspace import Package, Workspace

__all__ = ["check_description_text", "expanded_text", "robots_for", "whole_robots"]

# Where libyaml ends a plain scalar: a colon before white space, a number sign behind it.
_END = re.compile(r":(?=\s)|(?<=\s)#")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_PLUGINS = re.compile(r"gazebo_ros2_control|ign_ros2_control")
_SHOWN = 60
_MAX_FILES = 24
_HEAD = 20_000
_ENDINGS = (".urdf", ".urdf.xacro", ".xacro", ".urdf.xml")
# Half of the names may be wrong and it still is the robot that was meant.
_MIN_IN_COMMON = 0.5


def check_description_text(
    text: str, *, file: str, diagnostics: Diagnostics, sources: Sequence[Path] = ()
) -> None:
    """Report what keeps a robot description from being passed to a ROS 2 node as a parameter.

    gazebo_ros2_control and ign_ros2_control hand the text to the controller manager as
    ``-p robot_description:=…``, which is read as YAML (gazebo_ros2_control#295). A colon before
    white space makes a mapping of it; such colons stand in comments, as a rule.

    Args:
        text: URDF, expanded; texts without one of these plug-ins have no such finding.
        file: name for the places.
        diagnostics: receives the findings.
        sources: files that the text was expanded from, to say where a comment was written.
    """
    if not _PLUGINS.search(text):
        return
    comments = list(_COMMENT.finditer(text))
    for comment in comments:
        end = _END.search(text, comment.start() + 4, comment.end() - 3)
        if end is not None:
            shown = " ".join(comment[0].split())
            shown = f"{shown[:_SHOWN]}…" if len(shown) > _SHOWN else shown
            place = _written(comment[0], end.start() - comment.start(), sources)
            _report(
                place or _span(text, end.start(), file), end[0], f"the comment {shown}", diagnostics
            )
    outside = next((end for end in _END.finditer(text) if not _is_inside(end, comments)), None)
    if outside is not None:
        _report(_span(text, outside.start(), file), outside[0], "the description", diagnostics)


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


def _is_inside(end: re.Match[str], comments: list[re.Match[str]]) -> bool:
    return any(comment.start() <= end.start() < comment.end() for comment in comments)


def _written(comment: str, offset: int, sources: Sequence[Path]) -> SourceSpan | None:
    """Return the place of a comment in the files it may have come from."""
    for path in sources:
        try:
            text = path.read_text(encoding="utf-8", errors="replace")
        except OSError:
            continue
        start = text.find(comment)
        if start >= 0:
            return _span(text, start + offset, str(path))
    return None


def _span(text: str, start: int, file: str) -> SourceSpan:
    line = text.count("\n", 0, start) + 1
    return SourceSpan(file, line, start - text.rfind("\n", 0, start), 1)


def _report(span: SourceSpan, found: str, what: str, diagnostics: Diagnostics) -> None:
    sign = "a colon before a space" if found == ":" else "a # behind a space"
    message = f"{what} has {sign}: ros2_control's plug-in of Gazebo passes the description as a "
    message += "YAML parameter, where that ends the text (Couldn't parse parameter override rule); "
    message += "Gazelle passes it as it is"
    fix = f"take the '{found}' out, or the whole comment"
    diagnostics.report("parameters.colon-in-description", message, span, fix=fix)


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
