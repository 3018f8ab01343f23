"""``layout.*``: layouts of the page under names, in the user's configuration folder."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from urllib.parse import quote, unquote

from gazelle.documents.files import refused_version
from gazelle.studio.errors import StudioError, unknown
from gazelle.studio.request_params import Params
from gazelle.user_folders import config_folder

__all__ = ["delete_layout", "layout_folder", "list_layouts", "load_layout", "save_layout"]

_SUFFIX = ".json"
_MAX_BYTES = 4 << 20
_MAX_NAME = 100
_VERSION = 1


def layout_folder(environ: Mapping[str, str] = os.environ) -> Path:
    """Return where layouts are kept."""
    return config_folder(environ) / "layouts"


def list_layouts(_params: Params) -> list[str]:
    """``layout.list``: names, sorted."""
    return sorted(unquote(file.stem) for file in layout_folder().glob(f"*{_SUFFIX}"))


def load_layout(params: Params) -> Any:
    """``layout.load``."""
    name = params.text("name")
    try:
        saved = json.loads(_file(name).read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise unknown("layout", name, list_layouts(params)) from None
    except (OSError, ValueError) as error:
        raise StudioError(f"the layout '{name}' cannot be read: {error}") from None
    # Before there were versions a file held the layout itself.
    if not isinstance(saved, dict) or "version" not in saved:
        return saved
    if why := refused_version(f"the layout '{name}'", saved["version"], _VERSION):
        raise StudioError(why)
    return saved.get("layout")


def save_layout(params: Params) -> dict[str, Any]:
    """``layout.save``: a crash leaves the old one whole."""
    name = params.text("name")
    text = json.dumps({"version": _VERSION, "layout": params.any("value")})
    if len(text) > _MAX_BYTES:
        raise StudioError(f"the layout '{name}' has more than {_MAX_BYTES >> 20} MiB")
    file = _file(name)
    part = file.with_suffix(f".{os.getpid()}.part")
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        part.write_text(text, encoding="utf-8")
        part.replace(file)
    except OSError as error:
        raise StudioError(f"the layout '{name}' cannot be kept: {error}") from None
    return {}


def delete_layout(params: Params) -> dict[str, Any]:
    """``layout.delete``."""
    name = params.text("name")
    try:
        _file(name).unlink()
    except FileNotFoundError:
        raise unknown("layout", name, list_layouts(params)) from None
    return {}


def _file(name: str) -> Path:
    """A name may hold any character; the file's never leaves the folder."""
    if not name.strip() or len(name) > _MAX_NAME:
        raise StudioError(f"a layout's name has 1 to {_MAX_NAME} characters")
    return layout_folder() / f"{quote(name, safe=' ').replace('.', '%2E')}{_SUFFIX}"
