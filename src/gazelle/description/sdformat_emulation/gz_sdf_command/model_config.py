"""Which file of a model's folder sdformat reads: what ``model.config`` says of it."""

from __future__ import annotations

from pathlib import Path

from gazelle.description.sdformat_emulation.gz_sdf_command.console import Console
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics
from gazelle.documents.files import exists

__all__ = ["model_file", "version_numbers"]


def model_file(folder: Path, console: Console) -> Path | None:
    """Return the file of the newest version that the release reads; None, said why, if none.

    Args:
        folder: holds ``model.config``, or the older ``manifest.xml``.
        console: receives reasons.
    """
    config = folder / "model.config"
    if not exists(config):
        config = folder / "manifest.xml"
        if not exists(config):
            where = f"in [{folder}]" if console.release.is_new else "for the model"
            console.error("no-config", f"Could not find model.config or manifest.xml {where}")
            return None
        message = "The manifest.xml for a model is deprecated. Please rename manifest.xml to "
        console.warn("manifest", f"{message}model.config.")
    found = Diagnostics()
    root = read_xml(config, found)
    if root is None:
        reason = next(iter(found)).message
        console.error("parse-config", f"Error parsing XML in file [{config}]: {reason}")
        return None
    if root.name != "model":
        console.error("no-config-model", f"No <model> element in configFile[{config}]")
        return None
    name = _best_name(root, console)
    return folder / name if name else None


def version_numbers(text: str) -> tuple[int, ...]:
    """Return the numbers of a version such as ``1.9``; words in it count as 0."""
    return tuple(int(part) if part.isdigit() else 0 for part in text.strip().split("."))


def _best_name(root: Tag, console: Console) -> str:
    tags = root.find_all("sdf")
    chosen = tags[0] if tags else None
    best: tuple[int, ...] = (0, 0)
    for tag in tags:
        version = version_numbers(tag.attributes.get("version", "0.0"))
        if version <= best:
            continue
        if version <= console.release.spec:
            chosen, best = tag, version
        else:
            parser = "{}.{}".format(*console.release.spec)
            console.warn(
                "newer-model",
                f"Ignoring version {tag.attributes['version']} for model {root.text_of('name')} "
                f"because is newer than this sdf parser (version {parser})",
            )
    if chosen is None or not chosen.text:
        message = "Failure to detect an sdf tag in the model config file for model: "
        console.error("no-sdf-tag", message + root.text_of("name"))
        return ""
    if "version" not in chosen.attributes:
        console.warn(
            "no-config-version",
            "Can not find the XML attribute 'version' in sdf XML tag for model: "
            f"{root.text_of('name')}. Please specify the SDF protocol supported in the model "
            "configuration file. The first sdf tag in the config file will be used ",
        )
    return chosen.text
