"""Finding Gazebo models by name: model folders, Fuel caches, Gazelle's own."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from gazelle.documents.files import is_file

__all__ = [
    "folded",
    "folders_around",
    "fuel_model",
    "fuel_models",
    "is_model_folder",
    "models_in",
    "newest_version",
]

_FILES = ("model.config", "manifest.xml", "model.sdf")
_LEVELS = 4


def folded(name: str) -> str:
    """Return a model's name as folders have it: Fuel's "Ground Plane" is ``ground_plane``."""
    return "_".join(name.casefold().replace("-", " ").replace("_", " ").split())


def is_model_folder(folder: Path) -> bool:
    """Return whether a folder holds a model (``model.config`` or ``model.sdf``)."""
    return any(is_file(folder / name) for name in _FILES)


def folders_around(base_dir: Path | None) -> Iterator[Path]:
    """Yield folders near a file that may hold models: those around it and their ``models``.

    Args:
        base_dir: the file's folder; None yields nothing.
    """
    if base_dir is None:
        return
    here = base_dir.absolute()
    for folder in (here, *here.parents)[:_LEVELS]:
        yield folder
        yield folder / "models"


def models_in(folder: Path) -> Iterator[tuple[str, Path]]:
    """Yield name and folder of the models directly below a model folder, sorted."""
    try:
        with os.scandir(folder) as entries:
            names = sorted(entry.name for entry in entries if entry.is_dir())
    except OSError:
        return
    for name in names:
        if is_model_folder(folder / name):
            yield name, folder / name


def fuel_models(root: Path) -> Iterator[tuple[str, Path]]:
    """Yield name and newest version's folder of the models in a Fuel cache, sorted.

    Layout: ``<server>/<owner>/models/<name>/<version>``.
    """
    for models in sorted(root.glob("*/*/models")):
        try:
            names = sorted(os.listdir(models))  # noqa: PTH208
        except OSError:
            continue
        for name in names:
            folder = newest_version(models / name)
            if folder is not None:
                yield name, folder


def fuel_model(root: Path, owner: str, name: str) -> Path | None:
    """Return a cached Fuel model's newest version, upper and lower case alike."""
    for models in sorted(root.glob("*/*/models")):
        if models.parent.name.casefold() != owner.casefold():
            continue
        for candidate in sorted(models.iterdir()):
            if candidate.name.casefold() == name.casefold():
                return newest_version(candidate)
    return None


def newest_version(folder: Path) -> Path | None:
    """Return the highest numbered subfolder that holds a model, or the folder itself."""
    if is_model_folder(folder):
        return folder
    try:
        numbers = [name for name in os.listdir(folder) if name.isdigit()]  # noqa: PTH208
    except OSError:
        return None
    for number in sorted(numbers, key=int, reverse=True):
        if is_model_folder(folder / number):
            return folder / number
    return None
