"""``<include>``: the file found, read, renamed and placed, and put where the include stood."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf.console import Code, Console
from gazelle.description.sdformat_emulation.gz_sdf.element_reader import (
    Include,
    Place,
    Reading,
    default_element,
    read_element,
    set_attribute,
    set_text,
)
from gazelle.description.sdformat_emulation.gz_sdf.merging import flatten_into, merge_into
from gazelle.description.sdformat_emulation.gz_sdf.model_config import model_file, version_numbers
from gazelle.description.sdformat_emulation.gz_sdf.records import Document
from gazelle.description.sdformat_emulation.gz_sdf.specification import Definition, specification
from gazelle.description.sdformat_emulation.gz_sdf.values import bool_of, default_text
from gazelle.documents.files import is_folder

__all__ = ["read_include"]

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
    place = include.place
    here = Place(f"{place.path}/include[{include.index}]", place.file) if reading.is_new else place
    if reading.is_new:
        _validate(include, reading)
    file = _file_of(include.raw, here, reading, find)
    if file is None:
        return True
    document = open_file(file, reading.console)
    uri = include.raw.find("uri") or include.raw
    at = Place(f"{here.path}/uri", here.file)
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


def _validate(include: Include, reading: Reading) -> None:
    """Read the include by the specification only to hear what is wrong with it."""
    definition = include.definition.children.get("include")
    if definition is None:
        return
    place = Place("", include.place.file)
    if read_element(include.raw, definition, place, reading) is None:
        message = "Error reading element <include>"
        reading.fail(Code.ELEMENT_INVALID, message, place, include.raw.line)


def _file_of(raw: SdfElement, here: Place, reading: Reading, find: Find) -> Path | None:
    uri = raw.find("uri")
    if uri is None:
        message = "<include> element missing 'uri' attribute"
        reading.fail(Code.ATTRIBUTE_MISSING, message, here, raw.line)
        return None
    path = find(uri.text)
    at = Place(f"{here.path}/uri", here.file)
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


def _fail_to_find(uri: SdfElement, at: Place, reading: Reading) -> None:
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
            reading.fail(Code.ELEMENT_INCORRECT_TYPE, message, Place(f"/sdf/{other.name}", file))
        if len(root.find_all(top.name)) > 1:
            message = f"Found more than one {top.name} for <include>."
            reading.fail(Code.ELEMENT_INCORRECT_TYPE, message, Place(f"/sdf/{top.name}", file))
    return top


def _override(
    top: SdfElement, definition: Definition, include: Include, here: Place, reading: Reading
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
    top: SdfElement, definition: Definition, include: Include, here: Place, reading: Reading
) -> bool:
    placement = include.raw.find("placement_frame")
    if not reading.is_new or top.name != "model" or placement is None:
        return True
    at = Place(f"{here.path}/placement_frame", here.file)
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
    top: SdfElement, definition: Definition, raw: SdfElement, here: Place, reading: Reading
) -> bool:
    for number, plugin in enumerate(raw.find_all("plugin")):
        at = Place(f"{here.path}/plugin[{number}]", here.file)
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
    document: Document, top: SdfElement, include: Include, here: Place, reading: Reading
) -> None:
    parent = include.parent
    if not reading.is_new and parent.name == "model":
        flatten_into(parent, document, include.definition, here, reading)
    elif reading.is_new and bool_of(include.raw.attributes.get("merge", "false")):
        merge_into(parent, document, top, include, here, reading)
    else:
        # Whatever stands first in the file is taken, also if it is not what was renamed.
        assert document.root is not None
        parent.children.append(document.root.children[0])
