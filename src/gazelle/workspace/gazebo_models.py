"""Gazebo's models and worlds by name: model folders, Fuel caches, and what both Gazebos ship.

``builtin/originals.txt`` lists what they ship. A world or model that is here is Gazelle's own: it
has the names, places and sizes of the original and plain shapes instead of its meshes.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

from gazelle.documents.files import is_file
from gazelle.workspace.environment_paths import BUILTIN

__all__ = [
    "Original",
    "folded",
    "folders_around",
    "fuel_model",
    "fuel_models",
    "is_model_folder",
    "models_in",
    "newest_version",
    "original_models",
    "original_worlds",
    "originals_markdown",
]

_FILES = ("model.config", "manifest.xml", "model.sdf")
_LEVELS = 4
_LIST = BUILTIN / "originals.txt"
_WORLDS_AT = {
    "gz-sim": "https://github.com/gazebosim/gz-sim, examples/worlds",
    "Gazebo Classic": "https://github.com/gazebosim/gazebo-classic, worlds",
}
_MODELS_AT = "https://github.com/osrf/gazebo_models"
_HEAD = """# Worlds and models by name

What both Gazebos ship by name, and launch files refer to by name: `gz sim shapes.sdf`,
`worlds/empty.world`, `model://sun`, `https://fuel.gazebosim.org/…/models/Ground Plane`. Those that
are here are Gazelle's own: names, places and sizes are the original's, shapes are plain. Nothing is
downloaded; a model of that name on `GAZEBO_MODEL_PATH`, `GZ_SIM_RESOURCE_PATH`, in a package's
`models` folder or in Fuel's cache comes first. The others are refused by name, with where they are.
This page is generated: `python -m gazelle.workspace.gazebo_models > docs/worlds.md`.

"""


class Original(NamedTuple):
    """A world or a model that Gazebo has by this name.

    Attributes:
        kind: ``world`` or ``model``.
        name: a world's file name, a model's folder.
        owner: who ships it.
        about: what it is; for a world that is not here, what it is about.
        is_here: Gazelle has its own of this name.
        is_alike: it does what the original does; False where shapes stand for its meshes.
    """

    kind: str
    name: str
    owner: str
    about: str
    is_here: bool
    is_alike: bool

    @property
    def advice(self) -> str:
        """Why there is none on this machine, and what to do."""
        if self.kind == "model":
            return (
                f"'{self.name}' is a model of Gazebo's model database; Gazelle has none of its own "
                f"and downloads nothing: git clone {_MODELS_AT} and name that folder in "
                "GAZEBO_MODEL_PATH"
            )
        return (
            f"'{self.name}' ships with {self.owner} ({self.about}); Gazelle has none of its own: "
            f"take the file from {_WORLDS_AT[self.owner]}, and give its path"
        )

    def advice_for(self, inside: str) -> str:
        """Why a file of this model is not here though shapes stand in for it, and what to do."""
        return (
            f"plain shapes stand in for Gazebo's model '{self.name}', without its '{inside}': "
            f"git clone {_MODELS_AT} and name that folder in GAZEBO_MODEL_PATH"
        )


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


def original_worlds() -> Mapping[str, Original]:
    """Return the worlds by file name."""
    return _read()["world"]


def original_models() -> Mapping[str, Original]:
    """Return the models by folder name."""
    return _read()["model"]


def originals_markdown() -> str:
    """Return the page: worlds and models that are here, and the names of those that are not."""
    lines = ["## Worlds", "", "| world | of | what it is |", "| --- | --- | --- |"]
    for row in original_worlds().values():
        what = row.about if row.is_here else f"not here: {row.about}"
        lines.append(f"| `{row.name}` | {row.owner} | {what} |")
    lines += ["", "## Models", "", "| model | what it is |", "| --- | --- |"]
    models = list(original_models().values())
    lines += [f"| `{row.name}` | {row.about} |" for row in models if row.is_here]
    missing = ", ".join(f"`{row.name}`" for row in models if not row.is_here)
    lines += ["", f"Not here, by name: {missing}."]
    return _HEAD + "\n".join(lines) + "\n"


@cache
def _read() -> dict[str, dict[str, Original]]:
    found: dict[str, dict[str, Original]] = {"world": {}, "model": {}}
    for line in _LIST.read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        kind, name, owner, about = line.split(" | ", 3)
        is_here, is_alike = not about.startswith("-"), kind == "world" or about.startswith("=")
        about = about.lstrip("-= ")
        # The first of two Gazebos with a world of one name counts.
        found[kind].setdefault(name, Original(kind, name, owner, about, is_here, is_alike))
    return found


if __name__ == "__main__":
    sys.stdout.write(originals_markdown())
