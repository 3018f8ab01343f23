"""From what a user names (file, text, model, world) to descriptions."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from gazelle.description.model import Model, World
from gazelle.diagnostics import Diagnostics
from gazelle.diagnostics.nearest import nearest_names
from gazelle.errors import NotFoundError
from gazelle.workspace import Workspace

__all__ = ["Loaded", "models_from", "world_from"]


@dataclass(frozen=True, slots=True)
class Loaded:
    """What a source held: models, or a whole world."""

    models: tuple[Model, ...] = ()
    world: World | None = None


def models_from(
    source: str | os.PathLike[str] | Model | None,
    workspace: Workspace,
    diagnostics: Diagnostics,
    *,
    mappings: Mapping[str, str] | None = None,
) -> Loaded:
    """Read a model file, its text, a model folder or a known model's name.

    Raises:
        NotFoundError: neither a file nor a known model.
    """
    from gazelle.description.loader import load_models

    if source is None:
        return Loaded()
    if isinstance(source, Model):
        return Loaded((source,))
    text = os.fspath(source)
    if "<" not in text:
        path = _existing(text, workspace)
        if path.suffix == ".world":
            return Loaded(world=world_from(path, workspace, diagnostics))
        text = str(path)
    models = load_models(text, workspace=workspace, diagnostics=diagnostics, mappings=mappings)
    return Loaded(tuple(models))


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
    if not path.is_file():
        named = text if text.endswith((".world", ".sdf")) else f"worlds/{text}.world"
        found = workspace.world_file(named)
        if found.path is None:
            raise NotFoundError("world", text, searched=found.tried, nearest=found.nearest)
        path = found.path
    return load_world(path, workspace=workspace, diagnostics=diagnostics)


def _existing(text: str, workspace: Workspace) -> Path:
    path = Path(text).expanduser()
    if path.exists():
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
