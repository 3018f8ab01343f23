"""The files of an MJCF: read by our own reader first, for places and for what is missing."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["MjcfSource", "is_mjcf", "read_source"]

_ASSET_FOLDERS = {
    "hfield": "meshdir",
    "mesh": "meshdir",
    "skin": "meshdir",
    "texture": "texturedir",
}
_SPANNED = ("body", "geom", "joint", "freejoint", "site", "camera")


@dataclass(slots=True)
class MjcfSource:
    """An MJCF's elements with all it includes.

    Attributes:
        path: the file.
        root: its outermost element.
        spans: place of every named element, by element name and name.
        tags: all elements, included files' too, in document order.
    """

    path: Path
    root: Tag
    spans: dict[tuple[str, str], SourceSpan] = field(default_factory=dict)
    tags: list[Tag] = field(default_factory=list)

    def span(self, kind: str, name: str) -> SourceSpan:
        """Return where an element is written; the file's root for those without a name."""
        return self.spans.get((kind, name), self.root.span)

    def all_of(self, name: str) -> list[Tag]:
        """Return all elements of a name."""
        return [tag for tag in self.tags if tag.name == name]


def is_mjcf(path: Path) -> bool:
    """Tell whether a file's outermost element is ``<mujoco>``."""
    root = read_xml(path, Diagnostics()) if path.is_file() else None
    return root is not None and root.name == "mujoco"


def read_source(path: Path, diagnostics: Diagnostics) -> MjcfSource | None:
    """Read a file and what it includes; None when a part of it cannot be had (reported).

    Entities are refused, every missing file is named at its place.
    """
    root = read_xml(path, diagnostics)
    if root is None:
        return None
    source = MjcfSource(path, root)
    _gather(root, path.parent, source, diagnostics, (path.resolve(),))
    _check_assets(source, diagnostics)
    for tag in source.tags:
        if tag.name in _SPANNED and "name" in tag.attributes:
            kind = "joint" if tag.name == "freejoint" else tag.name
            source.spans[kind, tag.attributes["name"]] = tag.span
    return None if diagnostics.errors else source


def _gather(
    tag: Tag,
    folder: Path,
    source: MjcfSource,
    diagnostics: Diagnostics,
    chain: tuple[Path, ...],
) -> None:
    if tag.name != "include":
        source.tags.append(tag)
        for child in tag.children:
            _gather(child, folder, source, diagnostics, chain)
        return
    name = tag.attributes.get("file", "")
    file = folder / name
    if file.resolve() in chain:
        message = f"'{name}' includes itself"
        diagnostics.report("convert.mjcf", message, tag.span)
        return
    if not file.is_file():
        message = f"the included file '{file}' does not exist"
        diagnostics.report("convert.mjcf", message, tag.span, fix="correct the path")
        return
    root = read_xml(file, diagnostics)
    for child in root.children if root is not None else ():
        _gather(child, folder, source, diagnostics, (*chain, file.resolve()))


def _check_assets(source: MjcfSource, diagnostics: Diagnostics) -> None:
    folders = {"assetdir": "", "meshdir": "", "texturedir": ""}
    for tag in source.all_of("compiler"):
        folders |= {key: tag.attributes[key] for key in folders if key in tag.attributes}
    for tag in source.tags:
        name = tag.attributes.get("file")
        if tag.name not in _ASSET_FOLDERS or not name:
            continue
        own = folders[_ASSET_FOLDERS[tag.name]] or folders["assetdir"]
        file = source.path.parent / own / name
        if not file.is_file() and not (source.path.parent / name).is_file():
            message = f"the {tag.name} file '{file}' does not exist"
            diagnostics.report("convert.mjcf", message, tag.span, fix="correct the path")
