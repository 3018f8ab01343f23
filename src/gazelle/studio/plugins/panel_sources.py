"""Which panels there are: in files that were named, packages of the workspace, entry points.

Which ones a Python file has is read without running it.
"""

from __future__ import annotations

import ast
import importlib.util
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from gazelle.diagnostics import nearest_names
from gazelle.errors import GazelleError
from gazelle.extensions import ExtensionGroup, entry_points_of
from gazelle.studio.plugins.rqt.plugin_xml import rqt_plugins
from gazelle.workspace import Package, Workspace

__all__ = [
    "FOLDER",
    "PanelClass",
    "Source",
    "Unreadable",
    "all_sources",
    "named_file",
    "own_panel",
    "panel_classes",
    "sources_of_package",
]

_MODULES = ("gazelle.studio.plugins", "gazelle.studio.plugins.panel")
_MARK = "gazelle.studio"
_MAX_BYTES = 2 << 20
_TEXTS = ("title", "group", "about", "module")

FOLDER = "panels"
"""Folder of a package whose Python files are looked at."""


class PanelClass(NamedTuple):
    """A class that derives from `Panel`.

    Attributes:
        name: of the class.
        line: where it begins.
        texts: class attributes that are written as plain texts: title, group, about, module.
    """

    name: str
    line: int
    texts: dict[str, str]


class Unreadable(NamedTuple):
    """Why a file's panels are not known; it names file and line."""

    reason: str


def panel_classes(file: Path) -> tuple[PanelClass, ...] | Unreadable:
    """Return the panels of a file in order; none when it does not speak of Studio."""
    try:
        if file.stat().st_size > _MAX_BYTES:
            return ()
        text = file.read_text(encoding="utf-8", errors="replace")
        if _MARK not in text:
            return ()
        tree = ast.parse(text, str(file))
    except SyntaxError as error:
        return Unreadable(f"{file}:{error.lineno}: SyntaxError: {error.msg}")
    except (OSError, ValueError, MemoryError, RecursionError) as error:
        return Unreadable(f"{file}: {error}")
    bases = set(_names_of_panel(tree))
    found = []
    for node in tree.body:
        if not isinstance(node, ast.ClassDef):
            continue
        if any(ast.unparse(base) in bases for base in node.bases):
            bases.add(node.name)
            if not node.name.startswith("_"):
                found.append(PanelClass(node.name, node.lineno, dict(_texts(node))))
    return tuple(found)


class Source(NamedTuple):
    """A panel that could be opened; nothing of it has run.

    Attributes:
        name: ``package.Class``; unique.
        file: where its class is.
        class_name: of the class.
        line: where it begins.
        texts: title, group, about and module as far as they are written as texts.
        origin: what it belongs to, in words.
        folders: where the file may import from, besides its own folder.
        module_name: of an installed one, which is imported by its name.
        problem: why it cannot be opened, empty when it can.
    """

    name: str
    file: Path
    class_name: str
    line: int = 1
    texts: dict[str, str] = {}  # noqa: RUF012 - of a tuple, and never written
    origin: str = ""
    folders: tuple[Path, ...] = ()
    module_name: str = ""
    problem: str = ""

    @property
    def title(self) -> str:
        """What the menu says."""
        return self.texts.get("title") or self.class_name or self.file.name


def all_sources(named: Iterable[Source], workspace: Workspace) -> dict[str, Source]:
    """Return all panels by name: those that were named, the workspace's, installed ones."""
    found: dict[str, Source] = {}
    own = workspace.user_packages
    for package in own:
        for source in sources_of_package(package):
            _keep(found, source)
    for source in _installed():
        _keep(found, source)
    for source in named:
        found[source.name] = source
    return found


def named_file(argument: str) -> tuple[Source, ...]:
    """Return the panels that ``FILE.py`` or ``FILE.py:Class`` means.

    Raises:
        GazelleError: there is no such file, it cannot be read, or has no such panel.
    """
    path, wanted = _split(argument)
    file = Path(path).expanduser().absolute()
    if not file.is_file():
        raise GazelleError(f"--panel {argument}: there is no file {file}")
    classes = panel_classes(file)
    if isinstance(classes, Unreadable):
        raise GazelleError(f"--panel {argument}: {classes.reason}")
    if not classes:
        text = f"--panel {argument}: the file has no class that derives from "
        raise GazelleError(text + "gazelle.studio.plugins.Panel")
    names = [one.name for one in classes]
    if wanted and wanted not in names:
        nearest = ", ".join(nearest_names(wanted, names) or names)
        raise GazelleError(
            f"--panel {argument}: the file has no panel '{wanted}'; it has {nearest}"
        )
    chosen = [one for one in classes if wanted in ("", one.name)]
    return tuple(_source(file.stem, file, one, f"file {file}") for one in chosen)


def sources_of_package(package: Package) -> Iterator[Source]:
    """Yield the panels in a package's folder ``panels``."""
    folders = (package.path / "src", package.path)
    for file in sorted((package.path / FOLDER).glob("*.py")):
        classes = panel_classes(file)
        origin = f"package {package.name}"
        if isinstance(classes, Unreadable):
            name = f"{package.name}.{file.stem}"
            yield Source(name, file, "", origin=origin, problem=classes.reason)
            continue
        for one in classes:
            yield _source(package.name, file, one, origin)._replace(folders=folders)


def own_panel(argument: str) -> str:
    """Return the kind that ``rqt -s WORDS`` means among the user's panels, empty for none.

    A panel comes before a plug-in of rqt of the same name: it is what became of it.

    Args:
        argument: ``package.Class`` or ``Class`` of a panel; package, ``module.Class`` or
            ``package/module.Class`` of a plug-in of rqt.
    """
    workspace = Workspace.discover()
    for name, source in all_sources((), workspace).items():
        if argument in (name, source.class_name):
            return f"plugin:{name}"
    for plugin in rqt_plugins(workspace):
        class_name = re.split(r"\.|::", plugin.type)[-1]
        if argument in (plugin.name, plugin.type, plugin.package, class_name):
            return f"rqt-plugin:{plugin.name}"
    return ""


def _names_of_panel(tree: ast.Module) -> Iterator[str]:
    """Yield how the file may write the class `Panel`."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name in _MODULES:
                    yield f"{alias.asname or alias.name}.Panel"
        elif isinstance(node, ast.ImportFrom):
            for alias in node.names:
                name = alias.asname or alias.name
                if node.module in _MODULES and alias.name in ("Panel", "*"):
                    yield "Panel" if alias.name == "*" else name
                elif f"{node.module}.{alias.name}" in _MODULES:
                    yield f"{name}.Panel"


def _texts(node: ast.ClassDef) -> Iterator[tuple[str, str]]:
    for statement in node.body:
        match statement:
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.Constant(value=str(text))):
                pass
            case ast.AnnAssign(target=ast.Name(id=name), value=ast.Constant(value=str(text))):
                pass
            case _:
                continue
        if name in _TEXTS:
            yield name, text


def _installed() -> Iterator[Source]:
    for point in entry_points_of(ExtensionGroup.PANELS):
        module_name, _, class_name = point.value.partition(":")
        name = point.name.replace("/", ".")
        origin = f"entry point {point.name} = {point.value}"
        file = _file_of_module(module_name)
        if file is None:
            yield Source(
                name,
                Path(module_name),
                class_name,
                origin=origin,
                problem=f"{origin}: there is no module {module_name}",
            )
            continue
        classes = panel_classes(file)
        known = () if isinstance(classes, Unreadable) else classes
        found = next((one for one in known if one.name == class_name), None)
        made = _source("", file, found or PanelClass(class_name, 1, {}), origin)
        yield made._replace(name=name, module_name=module_name)


def _file_of_module(name: str) -> Path | None:
    """Return a module's file; only its first part is asked of Python, which runs nothing then."""
    top, *rest = name.split(".")
    try:
        spec = importlib.util.find_spec(top)
    except (ImportError, ValueError):
        return None
    if spec is None:
        return None
    if not rest:
        return Path(spec.origin) if spec.origin else None
    for place in spec.submodule_search_locations or ():
        path = Path(place, *rest)
        for file in (path.with_suffix(".py"), path / "__init__.py"):
            if file.is_file():
                return file
    return None


def _source(prefix: str, file: Path, one: PanelClass, origin: str) -> Source:
    name = f"{prefix}.{one.name}"
    return Source(name, file, one.name, one.line, one.texts, origin)


def _keep(found: dict[str, Source], source: Source) -> None:
    """Two of one name: the later one is named by its file too."""
    name = source.name
    if name in found:
        head, _, last = name.rpartition(".")
        name = f"{head}.{source.file.stem}.{last}" if head else f"{source.file.stem}.{last}"
    found.setdefault(name, source._replace(name=name))


def _split(argument: str) -> tuple[str, str]:
    """A drive letter has a colon too."""
    path, colon, wanted = argument.rpartition(":")
    return (path, wanted) if colon and wanted.isidentifier() else (argument, "")
