"""``model.config``: which SDF file of a model's folder to read."""

from __future__ import annotations

from pathlib import Path

from gazelle.description.context import ReadContext
from gazelle.description.sdf.versions import NEWEST_VERSION, version_from
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["model_file_in"]

_CONFIGS = ("model.config", "manifest.xml")
_USUAL_FILE = "model.sdf"


def model_file_in(folder: Path, context: ReadContext) -> Path | None:
    """Return the SDF file of a model's folder: the newest version that can be read.

    Without a ``model.config`` (or one that names a missing file) ``model.sdf`` is taken.

    Args:
        folder: the model's folder.
        context: hears of problems with the configuration.
    """
    config = next((folder / name for name in _CONFIGS if (folder / name).is_file()), None)
    usual = folder / _USUAL_FILE
    if config is None:
        return usual if usual.is_file() else None
    named = _best(_root(config, context), context, config)
    if named is not None and (folder / named).is_file():
        return folder / named
    if named is not None:
        message = f"'{config}' names '{named}', which is not in its folder"
        context.diagnostics.report("sdf.model-config", message, SourceSpan(str(config)))
    return usual if usual.is_file() else None


def _root(config: Path, context: ReadContext) -> Tag | None:
    """Return the file's root; a broken file is a warning, for ``model.sdf`` may stand beside it."""
    found = Diagnostics()
    root = read_xml(config, found)
    for item in found:
        message = f"{item.message}; model.sdf is tried"
        context.diagnostics.report("sdf.model-config", message, item.span)
    return root


def _best(root: Tag | None, context: ReadContext, config: Path) -> str | None:
    if root is None:
        return None
    candidates = [
        (version_from(tag.attributes.get("version")), tag) for tag in root.find_all("sdf")
    ]
    readable = [
        (version or (0, 0), tag.text)
        for version, tag in candidates
        if tag.text and (version or (0, 0)) <= NEWEST_VERSION
    ]
    if not readable:
        message = f"'{config}' names no SDF file of version 1.12 or older; model.sdf is tried"
        context.diagnostics.report("sdf.model-config", message, root.span)
        return None
    # max() keeps the first of equals, as Gazebo does.
    return max(readable, key=lambda item: item[0])[1]
