"""Documents as sdformat reads them: files, texts, URDF, and files that other files include."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from gazelle.description.sdformat_emulation.element import SdfElement, raw_element
from gazelle.description.sdformat_emulation.gz_sdf_command.console import (
    Code,
    Console,
    SdfError,
    error_line,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.element_reader import (
    Document,
    ElementLocation,
    Include,
    Reading,
    read_element,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.includes import read_include
from gazelle.description.sdformat_emulation.gz_sdf_command.model_config import (
    model_file,
    version_numbers,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.printer import to_text
from gazelle.description.sdformat_emulation.gz_sdf_command.specification import specification
from gazelle.description.sdformat_emulation.gz_sdf_command.version_upgrades import upgrade
from gazelle.description.sdformat_emulation.parser_urdf import urdf_to_sdf
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.documents import TEXT_BYTES, read_limited
from gazelle.documents.files import exists, is_folder

__all__ = ["normalised", "read_document", "read_document_file"]

# What may hold "<?" without being one, and what is one; the longest first.
_PIECES = re.compile(r"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<\?(?P<value>.*?)\?>|<", re.DOTALL)
_COLONS_FORBIDDEN = (1, 8)
_NO_ROBOT = (
    "Error:   Could not find the 'robot' element in the xml file\n"
    "         at line 109 in ./urdf_parser/src/model.cpp"
)
Find = Callable[[str], Path | None]


def read_document_file(word: str, *, release: Release, find: Find) -> Document:
    """Read a file, or a model's folder.

    Args:
        word: path of a file or folder.
        release: whose rules count.
        find: the file or folder that an address such as ``model://x`` means; None when there is
            none. Networks are not asked.
    """
    console = Console(release)
    path = Path(word)
    if not exists(path):
        found = find(word)
        if found is None:
            _say_unfound(word, console)
            return Document(None, "", (), console)
        path = found
    file: Path | None = path
    if is_folder(path):
        file = model_file(path, console)
    if file is None or not exists(file):
        console.error("no-file", f"File [{file or ''}] doesn't exist.")
        return Document(None, "", (), console)
    try:
        data = read_limited(file, TEXT_BYTES)
    except OSError as error:
        console.error("no-file", f"File [{file}] cannot be read: {error.strerror}.")
        return Document(None, "", (), console)
    return _read(data, str(file), console, find, (file.resolve(),))


def read_document(text: str | bytes, *, release: Release, file: str, find: Find) -> Document:
    """Read a document's text; `file` is its name in messages."""
    return _read(text, file, Console(release), find, ())


def normalised(element: SdfElement, release: Release) -> SdfElement | None:
    """Return ``<sdf version>…`` as the release's specification wants it; None when it refuses it.

    Args:
        element: of the release's version, such as `urdf_to_sdf` makes.
        release: whose rules count.
    """
    text = to_text(element, release)
    return read_document(text, release=release, file="<text>", find=lambda _word: None).root


def _declaration_problem(data: str | bytes) -> str:
    """Return what sdformat 12 prints of a declaration that stands too late, empty for none.

    TinyXML-2 (``XMLNode::ParseDeep``) takes declarations before anything else, comments included;
    TinyXML 1, which sdformat 9 uses, takes them anywhere.
    """
    text = data if isinstance(data, str) else data.decode("utf-8", "replace")
    is_start = True
    for piece in _PIECES.finditer(text):
        value = piece["value"]
        if value is None:
            is_start = False
        elif not is_start:
            line = text.count("\n", 0, piece.start()) + 1
            return (
                f"Error=XML_ERROR_PARSING_DECLARATION ErrorID=11 (0xb) Line number={line}: "
                f"XMLDeclaration value={value}"
            )
    return ""


def _say_unfound(word: str, console: Console) -> None:
    if console.release.is_new:
        console.error(
            "callback",
            "Tried to use callback in sdf::findFile(), but the callback is empty.  "
            "Did you call sdf::setFindCallback()?",
        )
    console.error("find-file", f"Error finding file [{word}].")


@dataclass(frozen=True, slots=True)
class _Includer:
    """Reads what ``<include>`` names, knowing which files are being read already."""

    find: Find
    chain: tuple[Path, ...]

    def __call__(self, reading: Reading, include: Include) -> bool:
        return read_include(reading, include, self.find, self.open)

    def open(self, path: Path, console: Console) -> Document:
        resolved = path.resolve()
        if resolved in self.chain:
            names = " -> ".join(str(one) for one in (*self.chain, resolved))
            # sdformat itself would call itself until its stack ends.
            console.plain(f"Error: files include each other in a circle: {names}")
            return Document(None, "", (), console)
        try:
            data = read_limited(path, TEXT_BYTES)
        except OSError as error:
            console.error("no-file", f"File [{path}] doesn't exist. ({error.strerror})")
            return Document(None, "", (), console)
        document = _read(data, str(path), console, self.find, (*self.chain, resolved))
        for item in document.errors:
            console.plain(error_line(item, console.release))
        return document


def _read(
    data: str | bytes, file: str, console: Console, find: Find, chain: tuple[Path, ...]
) -> Document:
    found = Diagnostics()
    tag = parse_xml(data, file, found)
    reason = "" if tag is None or console.release is Release.V9 else _declaration_problem(data)
    if tag is None or reason:
        reason = reason or next(iter(found)).message
        console.error("parse-xml", f"Error parsing XML in file [{file}]: {reason}")
        return Document(None, "", (), console)
    reading = Reading(console, _Includer(find, chain))
    if tag.name == "sdf" and "version" in tag.attributes:
        version = tag.attributes["version"]
        root = _read_sdf(raw_element(tag), file, reading)
        if root is not None:
            return _document(root, version, reading)
    if tag.name == "robot":
        return _read_robot(tag, reading)
    console.plain(_NO_ROBOT)
    return _document(None, tag.attributes.get("version", ""), reading)


def _document(root: SdfElement | None, version: str, reading: Reading) -> Document:
    return Document(
        root, version, tuple(reading.errors), reading.console,
        reading.included_from, reading.versions,
    )  # fmt: skip


def _read_robot(tag: Tag, reading: Reading) -> Document:
    remarks: list[str] = []
    raw = urdf_to_sdf(tag, release=reading.console.release, remarks=remarks)
    for remark in remarks:
        reading.console.plain(remark)
    if raw is None:
        return _document(None, "", reading)
    version = raw.attributes.get("version", "1.7")
    root = _read_sdf(raw, "urdf file", reading)
    if root is None:
        reading.console.error("parse-old", "parse as old deprecated model file failed.")
    return _document(root, version, reading)


def _read_sdf(raw: SdfElement, file: str, reading: Reading) -> SdfElement | None:
    version = raw.attributes["version"]
    spec = reading.console.release.spec
    if version != reading.console.release.spec_text:
        upgrade(raw, spec, reading.console)
    if reading.is_new and not _accepts_top_pose(raw, file, reading):
        message = "Errors were found when checking the XML of element<sdf>."
        reading.errors.append(SdfError(Code.ELEMENT_INVALID, message))
        return None
    definition = specification(reading.console.release)
    root = read_element(raw, definition, ElementLocation("/sdf", file), reading)
    if root is None:
        reading.errors.append(SdfError(Code.ELEMENT_INVALID, "Error reading element <sdf>"))
        return None
    if reading.is_new and version_numbers(version) >= _COLONS_FORBIDDEN:
        return root if _has_plain_names(root, reading) else None
    return root


def _accepts_top_pose(raw: SdfElement, file: str, reading: Reading) -> bool:
    model = raw.find("model")
    pose = model.find("pose") if model is not None else None
    relative_to = pose.attributes.get("relative_to", "") if pose is not None else ""
    if pose is None or not relative_to:
        return True
    message = (
        "Attribute //pose[@relative_to] of top level model must be left empty, found "
        f"//pose[@relative_to='{relative_to}'].\n"
    )
    reading.errors.append(SdfError(Code.ATTRIBUTE_INVALID, message, "", file, pose.line))
    return False


def _has_plain_names(root: SdfElement, reading: Reading) -> bool:
    colons = [one for one in _validated(root) if "::" in one.attributes.get("name", "")]
    for element in colons:
        text = to_text(element, reading.console.release)
        reading.console.plain(f"Error: Detected delimiter '::' in element name in\n{text}")
    if colons:
        message = (
            "Delimiter '::' found in attribute names of element <sdf>, which is not allowed in "
            "SDFormat >= 1.8"
        )
        reading.errors.append(SdfError(Code.RESERVED_NAME, message))
    return not colons


def _validated(element: SdfElement) -> list[SdfElement]:
    """Return an element and those below it, without plug-ins and elements of other namespaces."""
    if element.name == "plugin" or ":" in element.name:
        return []
    return [element, *(one for child in element.children for one in _validated(child))]
