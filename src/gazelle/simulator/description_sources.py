"""From what a user names (file, text, model, world) to descriptions."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from gazelle.description.model import Model, World
from gazelle.description.xml import parse_xml, read_xml
from gazelle.diagnostics import Diagnostics
from gazelle.diagnostics.suggestions import nearest_names
from gazelle.documents.files import exists, is_file
from gazelle.errors import NotFoundError
from gazelle.workspace import Workspace

__all__ = ["Loaded", "Source", "loaded_from", "models_from", "world_from"]


Source = str | os.PathLike[str] | Model


@dataclass(frozen=True, slots=True)
class Loaded:
    """What a source held: models, or a whole world."""

    models: tuple[Model, ...] = ()
    world: World | None = None


def loaded_from(
    source: Source | None,
    workspace: Workspace,
    diagnostics: Diagnostics,
    *,
    mappings: Mapping[str, str] | None = None,
) -> Loaded:
    """Read what `models_from` reads, or a world file or text, which stands for itself.

    Raises:
        NotFoundError: neither a file nor a known model.
        UserFileError: a world has errors.
    """
    from gazelle.description.loader import load_world

    if source is None:
        return Loaded()
    if not isinstance(source, Model):
        source = _text_or_path(source, workspace)
        if _holds_world(source):
            return Loaded(world=load_world(source, workspace=workspace, diagnostics=diagnostics))
    return Loaded(models_from(source, workspace, diagnostics, mappings=mappings))


def models_from(
    source: Source,
    workspace: Workspace,
    diagnostics: Diagnostics,
    *,
    mappings: Mapping[str, str] | None = None,
) -> tuple[Model, ...]:
    """Read a model file, its text, a model folder or a known model's name; a world's models too.

    Raises:
        NotFoundError: neither a file nor a known model.
    """
    from gazelle.description.loader import load_models

    if isinstance(source, Model):
        return (source,)
    text = _text_or_path(source, workspace)
    return load_models(text, workspace=workspace, diagnostics=diagnostics, mappings=mappings)


def world_from(
    source: str | os.PathLike[str] | None, workspace: Workspace, diagnostics: Diagnostics
) -> World:
    """Read a world file or a known world's name; an empty `World` for None.

    Raises:
        NotFoundError: neither a file nor a known world; lists where it was looked for.
    """
    from gazelle.description.loader import load_world

    if source is None:
        return World()
    text = os.fspath(source)
    path = Path(text)
    if not is_file(path):
        found = workspace.world_file(text)
        if found.path is None:
            raise NotFoundError(
                "world", text, searched=found.tried, nearest=found.nearest, hint=found.note
            )
        path = found.path
    return load_world(path, workspace=workspace, diagnostics=diagnostics)


def _text_or_path(source: str | os.PathLike[str], workspace: Workspace) -> str:
    text = os.fspath(source)
    return text if "<" in text else str(_existing(text, workspace))


def _holds_world(text: str) -> bool:
    """Return whether a file or text is SDF with a world in it; ``.sdf`` says nothing about that."""
    unheard = Diagnostics()
    if "<" in text:
        root = parse_xml(text, "<text>", unheard)
    elif Path(text).suffix == ".world":
        return True
    elif Path(text).suffix in {".sdf", ".xml"}:
        root = read_xml(Path(text), unheard)
    else:
        return False
    return root is not None and root.find("world") is not None


def _existing(text: str, workspace: Workspace) -> Path:
    path = Path(text).expanduser()
    if exists(path):
        return path
    if "://" in text:
        found = workspace.resolve(text)
        if found.path is None:
            raise NotFoundError("file", text, searched=found.tried, nearest=found.nearest)
        return found.path
    folder = workspace.model_dir(text)
    if folder is None:
        nearest = nearest_names(text, workspace.models)
        raise NotFoundError("file or model", text, searched=[str(path)], nearest=nearest)
    return folder
