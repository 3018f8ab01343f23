"""Included models whose parts become parts of the model that includes them.

Sdformat 9 does so with every model included in a model: names get ``model::`` in front. Sdformat 12
does it for ``<include merge='true'>``: names stay, and a frame stands for the included model's.
"""

from __future__ import annotations

import re

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf.checks import load
from gazelle.description.sdformat_emulation.gz_sdf.checks.pose_relative_to_graph import placed_pose
from gazelle.description.sdformat_emulation.gz_sdf.console import Code, SdfError
from gazelle.description.sdformat_emulation.gz_sdf.element_reader import (
    Include,
    Place,
    Reading,
    read_element,
)
from gazelle.description.sdformat_emulation.gz_sdf.printer import to_text
from gazelle.description.sdformat_emulation.gz_sdf.raw import raw_element
from gazelle.description.sdformat_emulation.gz_sdf.records import Document
from gazelle.description.sdformat_emulation.gz_sdf.specification import Definition, specification
from gazelle.description.sdformat_emulation.gz_sdf.values import (
    notation_of,
    pose_of,
    printed_pose,
)
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose

__all__ = ["flatten_into", "merge_into"]

_NAMED = ("link", "joint", "frame")
_MERGED = frozenset({"link", "model", "joint", "frame", "gripper", "plugin"})


def flatten_into(
    parent: SdfElement, document: Document, definition: Definition, here: Place, reading: Reading
) -> None:
    """Add the parts of an included model to a model, as sdformat 9 does.

    Names are exchanged in the printed text wherever they stand between quotes or tags: also in
    plug-ins' parameters that happen to be equal to a link's name.
    """
    root = document.root
    model = root.find("model") if root is not None else None
    if root is None or model is None:
        return
    name = model.attributes["name"]
    scope = f"{name}::__model__"
    names = {"__model__": scope}
    parent.children.append(_proxy_frame(model, scope, _first_link(model, f"{name}::")))
    for part in model.children:
        if part.name in _NAMED:
            names[part.attributes["name"]] = f"{name}::{part.attributes['name']}"
        if part.name == "link":
            pose = part.find("pose") or part.add("pose", "0 0 0 0 -0 0")
            if not pose.attributes.get("relative_to"):
                pose.attributes["relative_to"] = scope
        elif part.name == "frame" and not part.attributes.get("attached_to"):
            part.attributes["attached_to"] = scope
    text = _renamed(to_text(root, Release.V9), names)
    tag = parse_xml(text, here.file, Diagnostics())
    again = None
    if tag is not None:
        whole = specification(Release.V9)
        again = read_element(raw_element(tag), whole, Place("/sdf", here.file), reading)
    renamed = again.find("model") if again is not None else None
    if renamed is not None:
        parent.children += [part for part in renamed.children if part.name != "pose"]


def merge_into(
    parent: SdfElement,
    document: Document,
    top: SdfElement,
    include: Include,
    here: Place,
    reading: Reading,
) -> None:
    """Add the parts of an included model to a model without changing their names."""
    line = include.raw.line
    if top.name != "model":
        message = "Merge-include is only supported for included models"
        reading.fail(Code.MERGE_INCLUDE_UNSUPPORTED, message, here, line)
        return
    if parent.name != "model":
        message = f"Merge-include does not support parent element of type {parent.name}"
        reading.fail(Code.MERGE_INCLUDE_UNSUPPORTED, message, here, line)
        return
    pose = _placed_pose(document, top, reading)
    scope = f"_merged__{top.attributes['name']}__model__"
    frame = _proxy_frame(top, scope, _first_link(top, ""))
    frame.children[0].text = printed_pose(pose, signed_zero=True)
    parent.children.append(frame)
    for part in top.children:
        _refer_to_proxy(part, scope)
        if part.name in _MERGED or ":" in part.name:
            parent.children.append(part)


def _placed_pose(document: Document, top: SdfElement, reading: Reading) -> Pose:
    """Return the pose of a merged model's frame; errors in the model are noted."""
    loaded = load(document)
    reading.console.lines += loaded.console.lines
    reading.errors += loaded.errors
    found = top.find("pose")
    raw = Pose() if found is None else pose_of(found.text, notation_of(found.attributes))
    errors: list[SdfError] = []
    return raw if loaded.model is None else placed_pose(loaded.model, errors)


def _proxy_frame(model: SdfElement, name: str, link: str) -> SdfElement:
    """Return the frame that stands for an included model's own."""
    pose = model.find("pose")
    relative_to = pose.attributes.get("relative_to", "") if pose is not None else ""
    text = pose.text if pose is not None else "0 0 0 0 -0 0"
    frame = SdfElement("frame", {"name": name, "attached_to": link})
    frame.add("pose", text, relative_to=relative_to or "__model__")
    return frame


def _first_link(model: SdfElement, prefix: str) -> str:
    canonical = model.attributes.get("canonical_link", "")
    if canonical:
        return prefix + canonical
    link, nested = model.find("link"), model.find("model")
    if link is None and nested is not None:
        return _first_link(nested, f"{prefix}{nested.attributes['name']}::")
    return prefix + (link.attributes["name"] if link is not None else "")


def _refer_to_proxy(part: SdfElement, scope: str) -> None:
    pose = part.find("pose")
    if part.name in ("link", "model"):
        if pose is None:
            pose = part.add("pose", "0 0 0 0 0 0")
        if pose.attributes.get("relative_to", "") in ("", "__model__"):
            pose.attributes = {"relative_to": scope} | pose.attributes | {"relative_to": scope}
        return
    if part.name == "frame" and part.attributes.get("attached_to", "") in ("", "__model__"):
        part.attributes["attached_to"] = scope
    if part.name not in ("frame", "joint"):
        return
    axes = [axis.find("xyz") for axis in part.children if axis.name in ("axis", "axis2")]
    for element, key in ((pose, "relative_to"), *((xyz, "expressed_in") for xyz in axes)):
        if element is not None and element.attributes.get(key) == "__model__":
            element.attributes[key] = scope


def _renamed(text: str, names: dict[str, str]) -> str:
    for old in sorted(names):
        new = names[old].replace("\\", r"\\")
        pattern = f"(?<=\")({re.escape(old)})(?=\")|(?<=')({re.escape(old)})(?=')"
        text = re.sub(pattern, new, text)
        text = text.replace(f">{old}<", f">{names[old]}<")
    return text
