"""The text of a model that a file's name or address stands for."""

from __future__ import annotations

from pathlib import Path

from gazelle.documents.files import is_file
from gazelle.errors import GazelleError

__all__ = ["model_text"]

_INCLUDE = (
    '<sdf version="1.6"><world name="default"><include><uri>{uri}</uri></include></world></sdf>'
)
_MODEL_FILES = ("model.sdf", "model.urdf")


def model_text(name: str) -> str:
    """Return the XML of a model.

    Args:
        name: a file, a folder with a model in it, or an address (``model://``, ``package://``,
            ``https://fuel…``).

    Raises:
        GazelleError: there is none.
    """
    from gazelle.workspace import Workspace

    found = Workspace.discover().resolve(name)
    if found.path is None:
        raise GazelleError(found.explain(name))
    if is_file(found.path):
        return found.path.read_text(encoding="utf-8", errors="replace")
    file = next((found.path / one for one in _MODEL_FILES if is_file(found.path / one)), None)
    if file is None:
        # Its model.config says which file it is.
        return _INCLUDE.format(uri=name if "://" in name else Path(found.path).as_uri())
    return file.read_text(encoding="utf-8", errors="replace")
