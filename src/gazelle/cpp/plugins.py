"""Plug-in classes that packages declare for pluginlib, and the libraries that hold them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple
from xml.parsers import expat

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents.files import read_limited
from gazelle.workspace import Package, Workspace
from gazelle.workspace.ament_index import RESOURCE_INDEX_SUBFOLDER
from gazelle.workspace.building.cmake_lists import read_cmake_lists

__all__ = [
    "DeclaredPlugins",
    "PluginClass",
    "PluginDescriptionError",
    "declared_plugins",
    "library_file",
    "library_name",
    "read_description",
]

_MAX_BYTES = 1 << 20
_PREFIX = re.compile(r"\$\{(?:prefix|PROJECT_SOURCE_DIR|CMAKE_CURRENT_SOURCE_DIR)\}/?")
_EXPORT_FILE = "pluginlib_export_plugin_description_file"


class PluginDescriptionError(Exception):
    """A plug-in description cannot be read; the message says where and why."""


@dataclass(frozen=True, slots=True)
class PluginClass:
    """A class as a plug-in description has it.

    Attributes:
        name: by which it is looked up; the type's where none is given.
        type: of C++, such as ``my_pkg::MyClass``.
        base: the class that it can be used as.
        description: in words.
        library: as written, such as ``lib/libmy_pkg``.
        package: whose it is.
        manifest: the description's file.
        line: its line there.
    """

    name: str
    type: str
    base: str
    description: str
    library: str
    package: Package
    manifest: Path
    line: int = 0

    @property
    def span(self) -> SourceSpan:
        """Where it is declared."""
        return SourceSpan(str(self.manifest), self.line)


class DeclaredPlugins(NamedTuple):
    """What the packages of a workspace declare for one package and base class.

    Attributes:
        files: the descriptions that were read.
        classes: the classes of the base, by package and place.
        problems: what kept a description from being read.
    """

    files: tuple[Path, ...]
    classes: tuple[PluginClass, ...]
    problems: tuple[str, ...]


def declared_plugins(
    workspace: Workspace,
    provider: str,
    base: str = "",
    *,
    attribute: str = "plugin",
    files: Sequence[Path] = (),
) -> DeclaredPlugins:
    """Return the classes that packages export for a package such as ``nodelet``.

    ROS 1 names the description in ``<export><nodelet plugin="${prefix}/file.xml"/></export>``,
    ROS 2 by ``pluginlib_export_plugin_description_file`` or in the ament index.

    Args:
        workspace: whose packages are asked, all that are not Gazelle's own.
        provider: the package that has the base class.
        base: the base class; all classes where empty.
        attribute: of the export.
        files: descriptions to read in place of those that are exported.
    """
    found = (
        [(path, _owner(workspace, path)) for path in files]
        if files
        else [
            (path, package)
            for package in workspace.user_packages
            for path in _exported(package, provider, attribute)
        ]
    )
    classes: list[PluginClass] = []
    problems: list[str] = []
    for path, package in found:
        if package is None:
            problems.append(f"{path}: lies in no package")
            continue
        try:
            read = read_description(path, package)
        except PluginDescriptionError as error:
            problems.append(str(error))
            continue
        classes += [one for one in read if not base or one.base == base]
    return DeclaredPlugins(tuple(path for path, _ in found), tuple(classes), tuple(problems))


def read_description(path: Path, package: Package) -> tuple[PluginClass, ...]:
    """Return the classes of one plug-in description.

    Raises:
        PluginDescriptionError: it is missing, no XML, or lacks what every class needs.
    """
    collector = _Collector(path, package)
    try:
        data = read_limited(path, _MAX_BYTES)
        collector.parse(data)
    except OSError as error:
        text = error.strerror or str(error)
        raise PluginDescriptionError(
            f"{path}: the plug-in description cannot be read: {text}"
        ) from error
    except expat.ExpatError as error:
        reason = expat.ErrorString(error.code)
        text = f"{path}:{error.lineno}: the plug-in description is no XML: {reason}"
        raise PluginDescriptionError(text) from error
    if not collector.has_library:
        raise PluginDescriptionError(
            f'{path}: the plug-in description has no <library path="…"> with classes'
        )
    return tuple(collector.classes)


def library_name(written: str) -> str:
    """Return what a build file calls the library ``lib/libfoo``: ``foo``."""
    name = written.strip().rpartition("/")[2]
    return name.removesuffix(".so").removeprefix("lib")


def library_file(
    package: Package,
    written: str,
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    span: SourceSpan | None = None,
) -> Path | None:
    """Return the file of a library that a description names, compiled first where it is source.

    Args:
        package: whose it is.
        written: the library as the description has it.
        workspace: where the packages that it needs are.
        diagnostics: is told what keeps it from being compiled.
        span: where it is named.
    """
    if package.prefix is not None:
        name = library_name(written)
        places = (
            package.prefix / written,
            package.prefix / "lib" / f"lib{name}.so",
            package.prefix / "lib" / package.name / f"lib{name}.so",
        )
        return next((place for place in places if place.is_file()), None)
    from gazelle.cpp.building.build import ensure_library_built

    return ensure_library_built(
        package, library_name(written), workspace=workspace, diagnostics=diagnostics, span=span
    )


def _owner(workspace: Workspace, path: Path) -> Package | None:
    owners = [one for one in workspace.user_packages if path.is_relative_to(one.path)]
    return max(owners, key=lambda one: len(one.path.parts), default=None)


def _exported(package: Package, provider: str, attribute: str) -> Iterator[Path]:
    for export in package.exports:
        value = export.get(attribute) if export.name == provider else None
        if value:
            yield package.path / _PREFIX.sub("", value)
    if package.ros_version != 2:
        return
    if package.prefix is not None:
        index = package.prefix / RESOURCE_INDEX_SUBFOLDER / f"{provider}__pluginlib__plugin"
        entry = index / package.name
        if entry.is_file():
            lines = entry.read_text(encoding="utf-8", errors="replace").splitlines()
            yield from (package.prefix / line.strip() for line in lines if line.strip())
        return
    lists = read_cmake_lists(package.path, package.name)
    for step in () if lists is None else lists.called(_EXPORT_FILE):
        if len(step.arguments) >= 2 and step.arguments[0] == provider:
            file = _PREFIX.sub("", step.arguments[1])
            yield package.path / step.folder / file


class _Collector:
    """Collects ``<library><class/></library>``, with or without ``<class_libraries>`` around."""

    def __init__(self, path: Path, package: Package) -> None:
        self.classes: list[PluginClass] = []
        self.has_library = False
        self._path = path
        self._package = package
        self._library = ""
        self._open: dict[str, str] | None = None
        self._line = 0
        self._words: list[str] | None = None
        self._description = ""
        self._parser = expat.ParserCreate()

    def parse(self, data: bytes) -> None:
        parser = self._parser
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.EntityDeclHandler = self._entity
        # Several <library> beside each other were fine with TinyXML.
        declaration = re.match(rb"\s*<\?xml.*?\?>", data, re.DOTALL)
        head = declaration.group(0) if declaration else b""
        parser.Parse(head.lstrip() + b"<all>" + data[len(head) :] + b"</all>", True)

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        if name == "library":
            self.has_library = True
            self._library = attributes.get("path", "")
            if not self._library:
                raise self._problem("<library> has no attribute path")
        elif name == "class":
            if not self._library:
                raise self._problem("<class> stands outside of a <library>")
            self._open, self._line = attributes, self._parser.CurrentLineNumber
            self._description = ""
        elif name == "description":
            self._words = []

    def _end(self, name: str) -> None:
        if name == "library":
            self._library = ""
        elif name == "description" and self._words is not None:
            self._description = " ".join("".join(self._words).split())
            self._words = None
        elif name == "class" and self._open is not None:
            self.classes.append(self._made(self._open))
            self._open = None

    def _made(self, attributes: dict[str, str]) -> PluginClass:
        kind = attributes.get("type", "")
        base = attributes.get("base_class_type", attributes.get("base_class", ""))
        for word, value in (("type", kind), ("base_class_type", base)):
            if not value:
                raise self._problem(f"<class> has no attribute {word}", self._line)
        return PluginClass(
            attributes.get("name") or kind,
            kind,
            base,
            self._description,
            self._library,
            self._package,
            self._path,
            self._line,
        )

    def _text(self, data: str) -> None:
        if self._words is not None:
            self._words.append(data)

    def _entity(self, name: str, *_rest: object) -> None:
        raise self._problem(f"XML entities are refused ('{name}')")

    def _problem(self, text: str, line: int = 0) -> PluginDescriptionError:
        place = line or self._parser.CurrentLineNumber
        return PluginDescriptionError(f"{self._path}:{place}: {text}")
