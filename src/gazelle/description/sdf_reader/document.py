"""Whole SDF documents: texts, world files and model files."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path

from gazelle.description.model import Light, Model, World
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.known_elements import check_elements
from gazelle.description.sdf_reader.lights import read_light
from gazelle.description.sdf_reader.model_config import model_file_in
from gazelle.description.sdf_reader.models import ModelParts, included_model, read_model
from gazelle.description.sdf_reader.versions import upgraded, version_of
from gazelle.description.sdf_reader.worlds import read_world, report_actor
from gazelle.description.xml import Tag, parse_xml, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents.files import is_folder
from gazelle.workspace import Workspace

__all__ = ["SdfDocument", "read_model_file", "read_sdf", "read_world_file"]

_CONTENT = ("world", "model", "light", "actor", "include")


@dataclass(frozen=True, slots=True)
class SdfDocument:
    """What one SDF file holds.

    Attributes:
        worlds: its worlds, with everything they include.
        models: models outside of worlds; `T_world_model` is their own ``<pose>``.
        lights: lights outside of worlds.
        version: as written, empty when missing.
    """

    worlds: tuple[World, ...] = ()
    models: tuple[Model, ...] = ()
    lights: tuple[Light, ...] = ()
    version: str = ""


def read_sdf(source: str | bytes | Tag, *, context: ReadContext) -> SdfDocument:
    """Read an SDF document.

    Args:
        source: the text, or its root element.
        context: where it comes from and where problems are reported.

    Returns:
        What could be read; every problem is in ``context.diagnostics``.
    """
    root = source
    if not isinstance(root, Tag):
        parsed = parse_xml(root, context.file, context.diagnostics)
        if parsed is None:
            return SdfDocument()
        root = parsed
    root = upgraded(root, context)
    content = _content(root, context)
    if content is None:
        return SdfDocument()
    context = context.for_version(version_of(root, context) if root.name == "sdf" else (1, 12))
    check_elements(root, context)
    for tag in content:
        if tag.name == "actor":
            report_actor(tag, context)
    models = [_model(tag, context) for tag in content if tag.name in ("model", "include")]
    lights = [read_light(tag, context) for tag in content if tag.name == "light"]
    return SdfDocument(
        worlds=tuple(read_world(tag, context) for tag in content if tag.name == "world"),
        models=tuple(model for model in models if model is not None),
        lights=tuple(light for light in lights if light is not None),
        version=root.attributes.get("version", ""),
    )


def read_world_file(
    path: str | os.PathLike[str], *, workspace: Workspace | None, diagnostics: Diagnostics
) -> World | None:
    """Read a world file; its first world counts.

    A file that holds models only becomes a world with these models.

    Args:
        path: the file.
        workspace: resolves ``model://`` and ``package://``.
        diagnostics: receives every finding.

    Returns:
        The world; None (reported) when there is nothing to load.
    """
    file = Path(path)
    document = _read_file(file, workspace, diagnostics)
    if document is None:
        return None
    if document.worlds:
        return replace(document.worlds[0], file=file)
    if document.models or document.lights:
        return World(models=document.models, lights=document.lights, file=file)
    _report_none("world", file, diagnostics)
    return None


def read_model_file(
    path: str | os.PathLike[str], *, workspace: Workspace | None, diagnostics: Diagnostics
) -> Model | None:
    """Read a model file, or a model's folder: its ``model.config`` names the file.

    Args:
        path: an ``.sdf`` file or a folder.
        workspace: resolves ``model://`` and ``package://``.
        diagnostics: receives every finding.

    Returns:
        The first model; None (reported) when there is none.
    """
    file = Path(path)
    if is_folder(file):
        context = ReadContext(workspace, diagnostics, str(file), file)
        found = model_file_in(file, context)
        if found is None:
            message = f"'{file}' has neither model.config nor model.sdf"
            diagnostics.report("sdf.no-model", message, SourceSpan(str(file)))
            return None
        file = found
    document = _read_file(file, workspace, diagnostics)
    if document is None:
        return None
    models = document.models or tuple(item for world in document.worlds for item in world.models)
    if models:
        return replace(models[0], file=file)
    _report_none("model", file, diagnostics)
    return None


def _read_file(
    file: Path, workspace: Workspace | None, diagnostics: Diagnostics
) -> SdfDocument | None:
    root = read_xml(file, diagnostics)
    if root is None:
        return None
    base = file.resolve()
    context = ReadContext(workspace, diagnostics, str(file), base.parent, include_chain=(base,))
    return read_sdf(root, context=context)


def _report_none(kind: str, file: Path, diagnostics: Diagnostics) -> None:
    """Say that there is no model or world, unless it has been said why already."""
    if not any(item.span and item.span.file == str(file) for item in diagnostics.errors):
        message = f"'{file}' holds no {kind}"
        diagnostics.report("sdf.no-model", message, SourceSpan(str(file)))


def _content(root: Tag, context: ReadContext) -> tuple[Tag, ...] | None:
    """Return what stands in ``<sdf>``; a bare ``<model>`` or ``<world>`` is taken as it is."""
    if root.name in ("model", "world", "light"):
        return (root,)
    if root.name != "sdf":
        message = f"the root element is <{root.name}>, not <sdf>"
        context.diagnostics.report("sdf.empty", message, root.span)
        return None
    content = tuple(child for child in root.children if child.name in _CONTENT)
    if not content:
        message = "<sdf> holds neither world nor model, light or actor"
        context.diagnostics.report("sdf.empty", message, root.span)
        return None
    return content


def _model(tag: Tag, context: ReadContext) -> Model | None:
    reader = read_model if tag.name == "model" else included_model
    parts: ModelParts | None = reader(tag, context)
    if parts is None:
        return None
    placement = parts.frames.get(parts.placement_frame)
    T_world_model = parts.pose if placement is None else parts.pose @ placement.inverse()
    return replace(parts.model, T_world_model=T_world_model)
