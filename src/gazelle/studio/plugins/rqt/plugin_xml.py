"""Plug-ins of rqt, as packages export them: ``plugin.xml`` with classes of rqt_gui_py."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Package, Workspace

__all__ = ["RqtPlugin", "rqt_plugins"]

_BASES = ("rqt_gui_py::Plugin", "rqt_gui_cpp::Plugin")
_FILES = ("plugin.xml", "plugins.xml")


class RqtPlugin(NamedTuple):
    """A plug-in.

    Attributes:
        name: ``package/type``; unique.
        package: that exports it.
        type: ``module.Class``, in C++ ``namespace::Class``.
        label: in rqt's menu.
        base: class it derives from.
        manifest: the plugin.xml.
        line: of its ``<class>``.
        folder: of the package.
        library: ``path`` of its ``<library>``, where Python modules are below the package.
    """

    name: str
    package: str
    type: str
    label: str
    base: str
    manifest: Path
    line: int
    folder: Path
    library: str

    @property
    def is_python(self) -> bool:
        """False for C++."""
        return self.base == _BASES[0]

    @property
    def source(self) -> Path | None:
        """The Python file with the class, None when it is not where the manifest says."""
        if not self.is_python:
            return None
        parts = self.type.split(".")[:-1]
        for root in (self.folder / self.library, self.folder / "src", self.folder):
            module = root.joinpath(*parts)
            for file in (module.with_suffix(".py"), module / "__init__.py"):
                if parts and file.is_file():
                    return file
        return None


def rqt_plugins(workspace: Workspace) -> list[RqtPlugin]:
    """Return the plug-ins of rqt in the user's packages, by name."""
    found: dict[str, RqtPlugin] = {}
    for package in workspace.packages.values():
        if not package.is_builtin:
            for plugin in _of_package(package):
                found.setdefault(plugin.name, plugin)
    return [found[name] for name in sorted(found)]


def _of_package(package: Package) -> Iterator[RqtPlugin]:
    exported = package.exported_paths("rqt_gui", "plugin")
    files = dict.fromkeys((*exported, *(package.path / name for name in _FILES)))
    for file in files:
        root = read_xml(file, Diagnostics()) if file.is_file() else None
        if root is None:
            continue
        for library in (tag for tag in root.walk() if tag.name == "library"):
            for tag in library.find_all("class"):
                if tag.attributes.get("base_class_type") in _BASES:
                    yield _plugin(package, file, library, tag)


def _plugin(package: Package, file: Path, library: Tag, tag: Tag) -> RqtPlugin:
    kind = tag.attributes.get("type", "")
    return RqtPlugin(
        name=f"{package.name}/{kind}",
        package=package.name,
        type=kind,
        label=tag.text_of("qtgui", "label") or tag.attributes.get("name", "") or kind,
        base=tag.attributes["base_class_type"],
        manifest=file,
        line=tag.span.line,
        folder=package.path,
        library=library.attributes.get("path", "src"),
    )
