"""``model.config``: a model's name, author and SDF files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.versions import NEWEST_VERSION, version_from
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents.files import is_file

__all__ = ["ModelConfig", "model_file_in", "read_model_config"]

_CONFIGS = ("model.config", "manifest.xml")
_USUAL_FILE = "model.sdf"


@dataclass(frozen=True, slots=True)
class ModelConfig:
    """What a model's folder says about itself.

    Attributes:
        file: the ``model.config``.
        name: name shown to people; the model's own name stands in its SDF file.
        version: the model's version.
        description: free text.
        authors: name and e-mail address of each author.
        sdf_files: SDF version and file name, in document order.
    """

    file: Path
    name: str = ""
    version: str = ""
    description: str = ""
    authors: tuple[tuple[str, str], ...] = ()
    sdf_files: tuple[tuple[tuple[int, int], str], ...] = ()

    @property
    def best_file(self) -> str:
        """The file of the newest version up to 1.12, empty when there is none."""
        readable = [item for item in self.sdf_files if item[0] <= NEWEST_VERSION]
        # max() keeps the first of equals, as Gazebo does.
        return max(readable, key=lambda item: item[0])[1] if readable else ""


def read_model_config(folder: Path, context: ReadContext) -> ModelConfig | None:
    """Return a model folder's ``model.config``; None when there is none or it is broken."""
    file = next((folder / name for name in _CONFIGS if is_file(folder / name)), None)
    if file is None:
        return None
    root = _root(file, context)
    if root is None:
        return None
    return ModelConfig(
        file=file,
        name=root.text_of("name"),
        version=root.text_of("version"),
        description=" ".join(root.text_of("description").split()),
        authors=tuple(
            (item.text_of("name"), item.text_of("email")) for item in root.find_all("author")
        ),
        sdf_files=tuple(
            (version_from(item.attributes.get("version")) or (0, 0), item.text)
            for item in root.find_all("sdf")
            if item.text
        ),
    )


def model_file_in(folder: Path, context: ReadContext) -> Path | None:
    """Return the SDF file of a model's folder: the newest version that can be read.

    Without a ``model.config`` (or with one that names no usable file) ``model.sdf`` is taken.

    Args:
        folder: the model's folder.
        context: hears of problems with the configuration.
    """
    config = read_model_config(folder, context)
    usual = folder / _USUAL_FILE
    if config is not None:
        best = config.best_file
        if best and is_file(folder / best):
            return folder / best
        wrong = f"names '{best}', which is not in its folder" if best else "names no SDF file"
        message = f"'{config.file}' {wrong}; model.sdf is tried"
        context.diagnostics.report("sdf.model-config", message, SourceSpan(str(config.file)))
    return usual if is_file(usual) else None


def _root(config: Path, context: ReadContext) -> Tag | None:
    """Return the file's root; a broken file is a warning, for ``model.sdf`` may stand beside it."""
    found = Diagnostics()
    root = read_xml(config, found)
    for item in found:
        message = f"{item.message}; model.sdf is tried"
        context.diagnostics.report("sdf.model-config", message, item.span)
    return root
