"""Any description to models or a world: what it is is seen from its content, not its name."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from gazelle.description.errors_as_warnings import lenient_document, lenient_robot
from gazelle.description.model import Model, World
from gazelle.description.read_context import ReadContext
from gazelle.description.robot_description import TEXT_NAME, file_of_text, read_text
from gazelle.description.sdf_reader import SdfDocument, read_model_file, read_sdf, read_world_file
from gazelle.description.source_maps import placed
from gazelle.description.urdf_reader import read_urdf
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.diagnostics.collection import grouped
from gazelle.documents.files import exists, is_file, is_folder
from gazelle.workspace import Resolved, Workspace

__all__ = ["TEXT_NAME", "load_models", "load_world"]

_Read = TypeVar("_Read")
_SDF_ROOTS = frozenset({"gazebo", "light", "model", "sdf", "world"})
_MODEL_CONFIG = "model.config"
_OTHER_FORMATS = {
    "mujoco": "this is MuJoCo's format; turn it into a URDF: gazelle convert FILE -o robot.urdf",
}


def load_models(
    source: str | os.PathLike[str],
    *,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str] | None = None,
    inserts: bool = True,
) -> tuple[Model, ...]:
    """Read URDF, xacro or SDF: a file, a model's folder, a URI, a model's name, or the text.

    Args:
        source: a path, ``package://…``, ``model://…``, the name of a known model, or XML text
            (anything whose first character is ``<``).
        workspace: finds packages, models and meshes.
        diagnostics: receives every finding.
        mappings: values of ``<xacro:arg>`` by name, for xacro files.
        inserts: see `ReadContext`.

    Returns:
        The models; none when nothing could be read, with the reason reported as an error.
    """
    found = Diagnostics()
    models = _load_models(str(source), workspace, found, mappings, inserts=inserts)
    _pass_on(found, diagnostics)
    return models


def load_world(
    source: str | os.PathLike[str],
    *,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str] | None = None,
) -> World:
    """Read a world: an SDF world file, or a robot or model that then is all there is in it.

    Args:
        source: a path, a URI, or a name such as ``worlds/empty.world`` on Gazebo's paths.
        workspace: finds worlds, packages, models and meshes.
        diagnostics: receives every finding.
        mappings: values of ``<xacro:arg>`` by name, for xacro files.

    Raises:
        UserFileError: there is no world to be read; holds all findings.
    """
    text = str(source)
    found = Diagnostics()
    if text.lstrip("\ufeff \t\r\n").startswith("<"):
        world = _world_of_text(text, workspace, found)
    else:
        world = _world_of_path(text, workspace, found, mappings)
    _pass_on(found, diagnostics)
    if world is None:
        if not diagnostics.errors:
            shown = TEXT_NAME if text.lstrip().startswith("<") else text
            diagnostics.report("load.nothing", f"'{shown}' holds no world", SourceSpan(shown))
        diagnostics.raise_if_errors()
        raise AssertionError("an error was reported")
    return world


def _load_models(
    text: str,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str] | None,
    *,
    inserts: bool = True,
) -> tuple[Model, ...]:
    if text.lstrip("\ufeff \t\r\n").startswith("<"):
        return _models_of_text(text, workspace, diagnostics, inserts=inserts)
    path = _locate(text, workspace, diagnostics)
    if path is None:
        return ()
    if is_folder(path) or path.name == _MODEL_CONFIG:
        folder = path if is_folder(path) else path.parent
        model = _leniently(
            lambda found: read_model_file(folder, workspace=workspace, diagnostics=found),
            diagnostics,
        )
        return () if model is None else (model,)
    return _models_of_file(path, workspace, diagnostics, mappings, inserts=inserts)


def _pass_on(found: Diagnostics, diagnostics: Diagnostics) -> None:
    for item in grouped(found):
        diagnostics.add(item)


def _world_of_text(
    text: str, workspace: Workspace | None, diagnostics: Diagnostics
) -> World | None:
    span = file_of_text(text)
    context = ReadContext(workspace, diagnostics, span, None)
    root = read_text(text, diagnostics)
    if root is None:
        return None
    if root.name in _SDF_ROOTS:
        document = _document(root, context)
        if document.worlds:
            return document.worlds[0]
        return World(models=document.models) if document.models else None
    models = _models_of_root(root, context)
    return World(models=models) if models else None


def _world_of_path(
    text: str,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str] | None,
) -> World | None:
    found = _resolved(text, workspace)
    if found.path is None and workspace is not None:
        found = workspace.world_file(text)
    if found.path is None:
        _report_not_found("world", text, found, diagnostics)
        return None
    root = _peek(found.path) if is_file(found.path) else None
    if root in _SDF_ROOTS:
        file = found.path
        return _leniently(
            lambda heard: read_world_file(file, workspace=workspace, diagnostics=heard),
            diagnostics,
        )
    models = _load_models(str(found.path), workspace, diagnostics, mappings)
    return World(models=models, file=found.path) if models else None


def _peek(path: Path) -> str:
    """Return the name of a file's outermost element, empty when it cannot be read."""
    root = read_xml(path, Diagnostics())
    return "" if root is None else root.name


def _models_of_text(
    text: str, workspace: Workspace | None, diagnostics: Diagnostics, *, inserts: bool = True
) -> tuple[Model, ...]:
    span = file_of_text(text)
    root = read_text(text, diagnostics)
    context = ReadContext(workspace, diagnostics, span, None, inserts=inserts)
    return () if root is None else _models_of_root(root, context)


def _models_of_file(
    path: Path,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str] | None,
    *,
    inserts: bool = True,
) -> tuple[Model, ...]:
    root = read_xml(path, diagnostics)
    if root is None:
        return ()
    # Some write robot.xacro.urdf.
    is_xacro = ".xacro" in path.suffixes or _has_xacro(root)
    if is_xacro:
        # Most files are no xacro, which brings the DOM along.
        from gazelle.description.xacro import expand_xacro

        expanded = expand_xacro(
            path, mappings=mappings, workspace=workspace, diagnostics=diagnostics
        )
        root = None if expanded is None else expanded.tag(diagnostics)
    if root is None:
        return ()
    if not is_xacro:
        root = placed(root)
    folder = path.resolve().parent
    context = ReadContext(workspace, diagnostics, str(path), folder, inserts=inserts)
    return tuple(replace(model, file=path) for model in _models_of_root(root, context))


def _has_xacro(root: Tag) -> bool:
    return any(tag.name.startswith("xacro:") for tag in root.walk())


def _models_of_root(root: Tag, context: ReadContext) -> tuple[Model, ...]:
    if root.name == "robot":
        model = _robot(root, context)
        return () if model is None else (model,)
    if root.name in _SDF_ROOTS:
        document = _document(root, context)
        models = document.models or tuple(
            model for world in document.worlds for model in world.models
        )
        if not models and not context.diagnostics.errors:
            message = f"'{context.file}' holds no model"
            context.diagnostics.report("load.nothing", message, root.span)
        return models
    message = f"the outermost element of '{context.file}' is <{root.name}>"
    fix = _OTHER_FORMATS.get(root.name, "")
    context.diagnostics.report("load.unknown-format", message, root.span, fix=fix)
    return ()


def _robot(root: Tag, context: ReadContext) -> Model | None:
    found = Diagnostics()
    model = read_urdf(root, context=replace(context, diagnostics=found))
    for item in found if model is None else lenient_robot(root, found):
        context.diagnostics.add(item)
    return model


def _document(root: Tag, context: ReadContext) -> SdfDocument:
    return _leniently(
        lambda found: read_sdf(root, context=replace(context, diagnostics=found)),
        context.diagnostics,
    )


def _leniently(read: Callable[[Diagnostics], _Read], diagnostics: Diagnostics) -> _Read:
    """Return what is read of an SDF document, with warnings for what Gazebo goes on with."""
    found = Diagnostics()
    result = read(found)
    for item in lenient_document(found):
        diagnostics.add(item)
    return result


def _locate(text: str, workspace: Workspace | None, diagnostics: Diagnostics) -> Path | None:
    found = _resolved(text, workspace)
    if found.path is None and workspace is not None and "/" not in text:
        folder = workspace.model_dir(text)
        found = Resolved(folder) if folder is not None else workspace.resolve(f"model://{text}")
    if found.path is None:
        _report_not_found("robot or model", text, found, diagnostics)
    return found.path


def _resolved(text: str, workspace: Workspace | None) -> Resolved:
    path = Path(text)
    if exists(path):
        return Resolved(path)
    if workspace is not None:
        return workspace.resolve(text)
    return Resolved(None, (str(path.absolute()),))


def _report_not_found(kind: str, text: str, found: Resolved, diagnostics: Diagnostics) -> None:
    message = f"{kind} {found.explain(text)}"
    diagnostics.report("load.not-found", message, SourceSpan(text))
