"""A robot or world with the elements its links were read from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.description.model import Link, Model
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader import read_sdf
from gazelle.description.sdf_reader.model_config import model_file_in
from gazelle.description.source_maps import placed
from gazelle.description.urdf_reader import read_urdf
from gazelle.description.xacro import expand_xacro
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.workspace import Workspace

__all__ = ["CheckedSource", "links_below", "read_checked_source"]

_SDF_ROOTS = frozenset({"model", "sdf", "world"})
_Tags = dict[tuple[str, SourceSpan], Tag]


@dataclass
class CheckedSource:
    """Models and their files.

    Attributes:
        models: as read.
        tags: `<link>` elements by name and place.
    """

    models: tuple[Model, ...] = ()
    tags: _Tags = field(default_factory=dict)
    _files: set[str] = field(default_factory=set)

    def find_tag(self, link: Link) -> Tag | None:
        """Return the element a link was read from; included files are opened when needed."""
        if link.span is None:
            return None
        key = link.name.rpartition("::")[2], link.span
        if key not in self.tags and link.span.file not in self._files:
            self._files.add(link.span.file)
            root = read_xml(Path(link.span.file), Diagnostics())
            if root is not None:
                found = links_below(root)
                self.tags |= {key: tag for key, tag in found.items() if not _is_pattern(tag)}
        return self.tags.get(key)


def read_checked_source(
    path: Path,
    *,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str] | None = None,
) -> CheckedSource:
    """Read a URDF, xacro or SDF file, or a model's folder.

    Args:
        path: the file or folder.
        workspace: finds packages and meshes.
        diagnostics: receives every finding of the readers.
        mappings: values of ``<xacro:arg>`` by name.
    """
    context = ReadContext(workspace, diagnostics, str(path), path.resolve().parent)
    if path.is_dir():
        inside = model_file_in(path, context)
        if inside is None:
            message = f"'{path}' has neither model.config nor model.sdf"
            diagnostics.report("sdf.no-model", message, SourceSpan(str(path)))
            return CheckedSource()
        return read_checked_source(
            inside, workspace=workspace, diagnostics=diagnostics, mappings=mappings
        )
    root = read_xml(path, diagnostics)
    if root is not None and (path.suffix == ".xacro" or _has_xacro(root)):
        expanded = expand_xacro(
            path, mappings=mappings, workspace=workspace, diagnostics=diagnostics
        )
        root = None if expanded is None else expanded.tag(diagnostics)
    elif root is not None:
        root = placed(root)
    if root is None:
        return CheckedSource()
    return CheckedSource(_models(root, context), links_below(root), {str(path)})


def links_below(root: Tag) -> dict[tuple[str, SourceSpan], Tag]:
    """Return all ``<link>`` elements by name and place."""
    links = (tag for tag in root.walk() if tag.name == "link")
    return {(tag.attributes.get("name", "").strip(), tag.span): tag for tag in links}


def _models(root: Tag, context: ReadContext) -> tuple[Model, ...]:
    if root.name == "robot":
        model = read_urdf(root, context=context)
        return () if model is None else (model,)
    if root.name not in _SDF_ROOTS:
        message = f"the outermost element of '{context.file}' is <{root.name}>"
        context.diagnostics.report("load.unknown-format", message, root.span)
        return ()
    document = read_sdf(root, context=context)
    inside = tuple(model for world in document.worlds for model in world.models)
    return document.models + inside


def _has_xacro(root: Tag) -> bool:
    return any(tag.name.startswith("xacro:") for tag in root.walk())


def _is_pattern(tag: Tag) -> bool:
    """Tell whether xacro makes something else of an element, an ``<inertial>`` of a macro say."""
    values = (value for inner in tag.walk() for value in inner.attributes.values())
    return _has_xacro(tag) or any("${" in value or "$(" in value for value in values)
