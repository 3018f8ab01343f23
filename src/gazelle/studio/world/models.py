"""The models of the model paths, with their pictures."""

from __future__ import annotations

import io
import threading
from functools import lru_cache
from pathlib import Path
from typing import Any, TypedDict

from gazelle.description.xml import read_xml
from gazelle.diagnostics import Diagnostics, nearest_names
from gazelle.errors import GazelleError
from gazelle.studio.errors import StudioError
from gazelle.studio.http_answers import Answer
from gazelle.studio.request_params import Params
from gazelle.workspace import Workspace

__all__ = ["ModelEntry", "list_models", "model_folder", "thumbnail"]

_SIZE_PX = (160, 120)
_BACKGROUND = (0.16, 0.18, 0.22)
# One picture at a time: the page asks for all of them at once.
_drawing = threading.Lock()


class ModelEntry(TypedDict):
    """A model of the model paths.

    Attributes:
        path: its folder.
        thumbnail: where its picture is.
    """

    name: str
    title: str
    description: str
    path: str
    thumbnail: str


def list_models(_params: Params) -> list[ModelEntry]:
    """``world.models``: sorted by title."""
    models = [_described(name, folder) for name, folder in Workspace.discover().models.items()]
    return sorted(models, key=lambda model: model["title"].lower())


def model_folder(name: str) -> Path:
    """Return a model's folder.

    Raises:
        StudioError: no model path has it.
    """
    workspace = Workspace.discover()
    folder = workspace.model_dir(name)
    if folder is None:
        raise StudioError(
            f"there is no model '{name}' in the model paths",
            hint="add its folder's parent to GAZEBO_MODEL_PATH",
            known=nearest_names(name, workspace.models),
        )
    return folder


def thumbnail(_part: object, name: str) -> Answer | None:
    """``/thumbnail/<model>``: the model's own picture, else one drawn now; blank for lights."""
    from PIL import Image

    try:
        folder = model_folder(name)
    except StudioError:
        return None
    own = sorted((folder / "thumbnails").glob("*.png"))
    data = own[0].read_bytes() if own else _drawn(folder)
    return Answer(data or _png(Image.new("RGBA", (1, 1))), "image/png")


def _described(name: str, folder: Path) -> ModelEntry:
    title, description = _manifest(folder)
    return {
        "name": name,
        "title": title or name,
        "description": description,
        "path": str(folder),
        "thumbnail": f"/thumbnail/{name}",
    }


def _manifest(folder: Path) -> tuple[str, str]:
    """Return name and description of ``model.config``, empty where they cannot be read."""
    file = folder / "model.config"
    root = read_xml(file, Diagnostics())
    if root is None:
        return "", ""
    texts = {tag.name: " ".join(tag.text.split()) for tag in root.children}
    return texts.get("name", ""), texts.get("description", "")


@lru_cache(maxsize=256)
def _drawn(folder: Path) -> bytes:
    """Draw a model; empty when it cannot be read."""
    from PIL import Image

    from gazelle.description.loader import load_models
    from gazelle.description.model import World
    from gazelle.sensors.view_image import take_picture

    diagnostics = Diagnostics()
    try:
        with _drawing:
            workspace = Workspace.discover()
            models = load_models(str(folder), workspace=workspace, diagnostics=diagnostics)
            picture = take_picture(
                World(models=models),
                size_px=_SIZE_PX,
                background=_BACKGROUND,
                diagnostics=diagnostics,
            )
    except (GazelleError, ValueError):
        return b""
    return _png(Image.fromarray(picture.rgb))


def _png(image: Any) -> bytes:
    data = io.BytesIO()
    image.save(data, "PNG")
    return data.getvalue()
