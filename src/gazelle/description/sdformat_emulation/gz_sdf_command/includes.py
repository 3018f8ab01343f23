"""``<include>``: the file found, read, renamed and placed, and put where the include stood.

Sdformat 9 does so with every model included in a model: names get ``model::`` in front. Sdformat 12
does it for ``<include merge='true'>``: names stay, and a frame stands for the included model's.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from gazelle.description.sdformat_emulation.element import SdfElement, raw_element
from gazelle.description.sdformat_emulation.gz_sdf_command.checks import load
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.pose_relative_to_graph import (
    placed_pose,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.console import Code, Console, SdfError
from gazelle.description.sdformat_emulation.gz_sdf_command.element_reader import (
    Document,
    ElementLocation,
    Include,
    Reading,
    default_element,
    read_element,
    set_attribute,
    set_text,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.model_config import (
    model_file,
    version_numbers,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.printer import to_text
from gazelle.description.sdformat_emulation.gz_sdf_command.specification import (
    Definition,
    specification,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.values import (
    bool_of,
    default_text,
    notation_of,
    pose_of,
    printed_pose,
)
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.documents.files import is_folder
from gazelle.geometry import Pose

__all__ = ["read_include"]

_NAMED = ("link", "joint", "frame")
_MERGED = frozenset({"link", "model", "joint", "frame", "gripper", "plugin"})
_TOP_LEVEL = ("model", "actor", "light")
_PARAMS = "experimental:params"
Open = Callable[[Path, Console], Document]
Find = Callable[[str], Path | None]


def read_include(reading: Reading, include: Include, find: Find, open_file: Open) -> bool:
    """Put what an ``<include>`` names into the element it stands in.

    Args:
        reading: receives errors.
        include: the element and where its content goes.
        find: the file or folder that an address means.
        open_file: reads a file as a document.

    Returns:
        False when the element that holds the include cannot be read because of it.
    """
    location = include.location
    here = (
        ElementLocation(f"{location.path}/include[{include.index}]", location.file)
        if reading.is_new
        else location
    )
    if reading.is_new:
        _validate(include, reading)
    file = _file_of(include.raw, here, reading, find)
    if file is None:
        return True
    document = open_file(file, reading.console)
    uri = include.raw.find("uri") or include.raw
    at = ElementLocation(f"{here.path}/uri", here.file)
    if document.root is None:
        reading.fail(Code.FILE_READ, f"Unable to read file[{file}]", at, uri.line)
        return False
    reading.included_from |= document.included_from
    reading.versions |= document.versions
    top = _top_level(document.root, str(file), reading)
    if top is None:
        message = "Failed to find top level <model> / <actor> / <light> for <include>\n"
        reading.fail(Code.ELEMENT_MISSING, message, at, uri.line)
        return True
    definition = specification(reading.console.release).children[top.name].resolved
    if not _override(top, definition, include, here, reading):
        return False
    reading.included_from[id(top)] = include.raw
    reading.versions[id(top)] = version_numbers(document.original_version)
    _insert(document, top, include, here, reading)
    return True


def _flatten_into(
    parent: SdfElement,
    document: Document,
    definition: Definition,
    here: ElementLocation,
    reading: Reading,
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
        again = read_element(raw_element(tag), whole, ElementLocation("/sdf", here.file), reading)
    renamed = again.find("model") if again is not None else None
    if renamed is not None:
        parent.children += [part for part in renamed.children if part.name != "pose"]


def _merge_into(
    parent: SdfElement,
    document: Document,
    top: SdfElement,
    include: Include,
    here: ElementLocation,
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


def _validate(include: Include, reading: Reading) -> None:
    """Read the include by the specification only to hear what is wrong with it."""
    definition = include.definition.children.get("include")
    if definition is None:
        return
    location = ElementLocation("", include.location.file)
    if read_element(include.raw, definition, location, reading) is None:
        message = "Error reading element <include>"
        reading.fail(Code.ELEMENT_INVALID, message, location, include.raw.line)


def _file_of(raw: SdfElement, here: ElementLocation, reading: Reading, find: Find) -> Path | None:
    uri = raw.find("uri")
    if uri is None:
        message = "<include> element missing 'uri' attribute"
        reading.fail(Code.ATTRIBUTE_MISSING, message, here, raw.line)
        return None
    path = find(uri.text)
    at = ElementLocation(f"{here.path}/uri", here.file)
    if path is None:
        _fail_to_find(uri, at, reading)
        return None
    if not is_folder(path):
        if reading.is_new:
            return path
        message = f"Directory doesn't exist[{path}]"
        reading.fail(Code.DIRECTORY_NONEXISTENT, message, at, uri.line)
        return None
    file = model_file(path, reading.console)
    if file is None and reading.is_new:
        message = (
            f"Unable to resolve uri[{uri.text}] to model path [{path}] since it does not contain "
            "a model.config file."
        )
        reading.fail(Code.URI_LOOKUP, message, at, uri.line)
    return file if file is not None or reading.is_new else path


def _fail_to_find(uri: SdfElement, at: ElementLocation, reading: Reading) -> None:
    if reading.is_new:
        reading.console.error(
            "callback",
            "Tried to use callback in sdf::findFile(), but the callback is empty.  "
            "Did you call sdf::setFindCallback()?",
        )
    reading.fail(Code.URI_LOOKUP, f"Unable to find uri[{uri.text}]", at, uri.line)
    if not reading.is_new and not uri.text.startswith("model://"):
        message = f"Invalid uri[{uri.text}]. Should be model://{uri.text}"
        reading.fail(Code.URI_INVALID, message, at, uri.line)


def _top_level(root: SdfElement, file: str, reading: Reading) -> SdfElement | None:
    """Return the first model, else actor, else light of a file; complain about further ones."""
    found = [child for name in _TOP_LEVEL for child in root.find_all(name)[:1]]
    if not found:
        return None
    top = found[0]
    if reading.is_new:
        for other in found[1:]:
            message = (
                f"Found other top level element <{other.name}> in addition to <{top.name}> in "
                "include file."
            )
            reading.fail(
                Code.ELEMENT_INCORRECT_TYPE, message, ElementLocation(f"/sdf/{other.name}", file)
            )
        if len(root.find_all(top.name)) > 1:
            message = f"Found more than one {top.name} for <include>."
            reading.fail(
                Code.ELEMENT_INCORRECT_TYPE, message, ElementLocation(f"/sdf/{top.name}", file)
            )
    return top


def _override(
    top: SdfElement,
    definition: Definition,
    include: Include,
    here: ElementLocation,
    reading: Reading,
) -> bool:
    """Give an included element the name, pose and so on that its include asks for."""
    raw, console = include.raw, reading.console
    name, pose = raw.find("name"), raw.find("pose")
    if name is not None:
        set_attribute(top, definition, "name", name.text, console)
    if pose is not None:
        _override_pose(_own(top, definition, "pose", console), definition, pose, console)
    static = raw.find("static")
    if top.name == "model" and static is not None:
        parameter = definition.children["static"].value
        if parameter is not None:
            set_text(_own(top, definition, "static", console), parameter, static.text, console)
    if not _override_placement(top, definition, include, here, reading):
        return False
    if top.name in ("model", "actor") and not _add_plugins(top, definition, raw, here, reading):
        return False
    if reading.is_new and raw.find(_PARAMS) is not None:
        console.plain(f"<{_PARAMS}> of line {raw.line} is not applied: Gazelle does not read it")
    return True


def _override_pose(
    pose: SdfElement, definition: Definition, wanted: SdfElement, console: Console
) -> None:
    known = definition.children["pose"]
    for item in known.attributes:
        pose.attributes.pop(item.key, None)
        if item.key in wanted.attributes:
            set_attribute(pose, known, item.key, wanted.attributes[item.key], console)
    if known.value is None:
        return
    if wanted.text:
        set_text(pose, known.value, wanted.text, console)
    else:
        pose.text = default_text(known.value, console)


def _override_placement(
    top: SdfElement,
    definition: Definition,
    include: Include,
    here: ElementLocation,
    reading: Reading,
) -> bool:
    placement = include.raw.find("placement_frame")
    if not reading.is_new or top.name != "model" or placement is None:
        return True
    at = ElementLocation(f"{here.path}/placement_frame", here.file)
    if include.raw.find("pose") is None:
        message = "<pose> is required when specifying the placement_frame element"
        reading.fail(Code.MODEL_PLACEMENT_FRAME_INVALID, message, at, include.raw.line)
        return False
    if placement.text == "__root__":
        message = (
            f"'{placement.text}' is reserved; it cannot be used as a value of element "
            "[placement_frame]"
        )
        reading.fail(Code.RESERVED_NAME, message, at, placement.line)
    set_attribute(top, definition, "placement_frame", placement.text, reading.console)
    return True


def _add_plugins(
    top: SdfElement,
    definition: Definition,
    raw: SdfElement,
    here: ElementLocation,
    reading: Reading,
) -> bool:
    for number, plugin in enumerate(raw.find_all("plugin")):
        at = ElementLocation(f"{here.path}/plugin[{number}]", here.file)
        found = read_element(plugin, definition.children["plugin"], at, reading)
        if found is None:
            reading.fail(Code.ELEMENT_INVALID, "Error reading plugin element", at, plugin.line)
            return False
        top.children.append(found)
    return True


def _own(top: SdfElement, definition: Definition, name: str, console: Console) -> SdfElement:
    """Return a child, made with defaults where it is missing."""
    found = top.find(name)
    if found is None:
        found = default_element(definition.children[name], console)
        top.children.append(found)
    return found


def _insert(
    document: Document, top: SdfElement, include: Include, here: ElementLocation, reading: Reading
) -> None:
    parent = include.parent
    if not reading.is_new and parent.name == "model":
        _flatten_into(parent, document, include.definition, here, reading)
    elif reading.is_new and bool_of(include.raw.attributes.get("merge", "false")):
        _merge_into(parent, document, top, include, here, reading)
    else:
        # Whatever stands first in the file is taken, also if it is not what was renamed.
        assert document.root is not None
        parent.children.append(document.root.children[0])
