"""Reading ``package.xml`` (formats 1 to 3) and the older ``manifest.xml`` of rosbuild."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple
from xml.parsers import expat

from gazelle.documents import read_limited
from gazelle.documents.malformed_xml import malformed_xml

__all__ = [
    "MANIFEST_BYTES",
    "Dependency",
    "Export",
    "Manifest",
    "ManifestError",
    "quick_name",
    "read_manifest",
]

MANIFEST_BYTES = 4 << 20
"""Size of the largest manifest that is read, in bytes."""

_MAX_DEPTH = 100
_COMMENT = re.compile(rb"<!--.*?-->", re.DOTALL)
_NAME = re.compile(rb"<name>\s*([^<\s]+)\s*</name>")
_DEPENDS = frozenset(
    {
        "build_depend",
        "build_export_depend",
        "buildtool_depend",
        "buildtool_export_depend",
        "depend",
        "doc_depend",
        "exec_depend",
        "run_depend",
        "test_depend",
    }
)


class Dependency(NamedTuple):
    """One dependency as written.

    Attributes:
        kind: its tag, such as ``exec_depend``.
        name: of the package or system library needed.
    """

    kind: str
    name: str


class Export(NamedTuple):
    """One element of ``<export>``.

    Attributes:
        name: tag name, such as ``gazebo_ros`` or ``build_type``.
        attributes: attribute names and values in document order, ``${prefix}`` not replaced.
        text: stripped text.
    """

    name: str
    attributes: tuple[tuple[str, str], ...]
    text: str

    def get(self, attribute: str) -> str | None:
        """Return an attribute's value, None when it is absent."""
        return next((value for key, value in self.attributes if key == attribute), None)


class ManifestError(Exception):
    """A manifest cannot be read.

    Attributes:
        line: line from 1, 0 when unknown.
        column: column from 1, 0 when unknown.
    """

    def __init__(self, reason: str, line: int = 0, column: int = 0) -> None:
        self.line = line
        self.column = column
        super().__init__(reason)


@dataclass(frozen=True, slots=True)
class Manifest:
    """What a package says about itself.

    Attributes:
        name: package name; empty when the file has none.
        version: as written; empty when absent.
        description: its text in one line.
        format: 1, 2 or 3 (REP-127, REP-140, REP-149); 0 for rosbuild's ``manifest.xml``.
        build_type: ``catkin``, ``ament_cmake``, ``ament_python``, ``rosbuild``, ``cmake``.
        depends: names of all dependencies, sorted, each once.
        dependencies: the same with their kinds, in document order.
        maintainers: as ``name <address>``.
        licenses: as written.
        exports: elements of ``<export>``.
    """

    name: str
    version: str = ""
    description: str = ""
    format: int = 1
    build_type: str = ""
    depends: tuple[str, ...] = ()
    exports: tuple[Export, ...] = ()
    dependencies: tuple[Dependency, ...] = ()
    maintainers: tuple[str, ...] = ()
    licenses: tuple[str, ...] = ()


def quick_name(data: bytes) -> str | None:
    """Return the package name without parsing the whole file; None when there is none."""
    # Behind the last '-->' no comment ends, and looking for the end of each would take for ever.
    end = data.rfind(b"-->") + 3
    found = _NAME.search(_COMMENT.sub(b"", data[:end]) + data[end:] if end > 2 else data)
    return found.group(1).decode("utf-8", "replace") if found else None


def read_manifest(path: Path) -> Manifest:
    """Read a ``package.xml`` or ``manifest.xml``.

    Raises:
        ManifestError: the file is unreadable, not well-formed, or not a package's.
    """
    collector = _Collector()
    try:
        data = read_limited(path, MANIFEST_BYTES)
        collector.parse(data)
    except OSError as error:
        raise ManifestError(error.strerror or str(error)) from error
    except expat.ExpatError as error:
        found = malformed_xml(data, error)
        raise ManifestError(found.message, found.line, found.column) from error
    except (LookupError, ValueError) as error:
        # Python's own words about an encoding that is unknown or of several bytes.
        raise ManifestError(f"not well-formed XML: {error}", 1, 1) from error
    if collector.root != "package":
        raise ManifestError(f"the root element is <{collector.root}>, not <package>", 1, 1)
    return _manifest(collector, is_rosbuild=path.name == "manifest.xml")


@dataclass(slots=True)
class _Collector:
    """Keeps the package's direct children and those of ``<export>``, nothing deeper."""

    root: str = ""
    root_attributes: Mapping[str, str] = field(default_factory=dict)
    fields: list[tuple[str, dict[str, str], str]] = field(default_factory=list)
    exports: list[Export] = field(default_factory=list)
    _stack: list[tuple[str, dict[str, str], list[str]]] = field(default_factory=list)

    def parse(self, data: bytes) -> None:
        parser = expat.ParserCreate()
        parser.buffer_text = True
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.EntityDeclHandler = self._entity
        parser.Parse(data.lstrip(), True)

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        if not self._stack:
            self.root, self.root_attributes = name, attributes
        if len(self._stack) >= _MAX_DEPTH:
            raise ManifestError(f"<{name}> is nested deeper than {_MAX_DEPTH} elements")
        self._stack.append((name, attributes, []))

    def _end(self, name: str) -> None:
        _, attributes, parts = self._stack.pop()
        text = " ".join("".join(parts).split())
        if len(self._stack) == 1:
            self.fields.append((name, attributes, text))
        elif len(self._stack) == 2 and self._stack[1][0] == "export":
            self.exports.append(Export(name, tuple(attributes.items()), text))

    def _text(self, data: str) -> None:
        for _, _, parts in self._stack[1:]:
            parts.append(data)

    def _entity(self, name: str, *_rest: object) -> None:
        raise ManifestError(f"XML entities are refused ('{name}')")


def _manifest(collector: _Collector, *, is_rosbuild: bool) -> Manifest:
    texts: dict[str, str] = {}
    for name, _, text in collector.fields:
        texts.setdefault(name, text)
    depends = {text for name, _, text in collector.fields if name in _DEPENDS and text}
    if is_rosbuild:
        depends = {
            attributes["package"]
            for name, attributes, _ in collector.fields
            if name == "depend" and "package" in attributes
        }
    tools = {text for name, _, text in collector.fields if name == "buildtool_depend"}
    exports = tuple(collector.exports)
    return Manifest(
        name=texts.get("name", ""),
        version=texts.get("version", ""),
        description=texts.get("description", ""),
        format=0 if is_rosbuild else _format(collector.root_attributes),
        build_type="rosbuild" if is_rosbuild else _build_type(exports, tools),
        depends=tuple(sorted(depends)),
        exports=exports,
        dependencies=tuple(
            Dependency(name, text) for name, _, text in collector.fields if name in _DEPENDS
        ),
        maintainers=tuple(_people(collector)),
        licenses=tuple(text for name, _, text in collector.fields if name == "license"),
    )


def _people(collector: _Collector) -> Iterator[str]:
    for name, attributes, text in collector.fields:
        if name == "maintainer":
            address = attributes.get("email", "")
            yield f"{text} <{address}>" if address else text


def _format(attributes: Mapping[str, str]) -> int:
    text = attributes.get("format", "1").strip()
    return int(text) if text in {"1", "2", "3"} else 1


def _build_type(exports: tuple[Export, ...], tools: set[str]) -> str:
    """REP-149: ``<build_type>`` decides; without one, catkin."""
    for export in exports:
        if export.name == "build_type" and export.text:
            return export.text
    for tool in ("ament_cmake", "ament_cmake_auto", "ament_cmake_ros", "ament_python"):
        if tool in tools:
            return "ament_python" if tool == "ament_python" else "ament_cmake"
    return "catkin"
