"""Imports that only exist here: message packages, packages of the workspace, their ``.cfg`` files.

Message classes take the form of ROS 1 or ROS 2, see `gazelle.compat.ros_version`.
They stand last in ``sys.meta_path``, so whatever is installed wins; before them only Gazelle's own
drop-in modules are looked at, for the sentences of what they do not have.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.machinery import ModuleSpec, SourceFileLoader
from importlib.util import spec_from_file_location, spec_from_loader
from pathlib import Path
from types import CodeType, ModuleType
from typing import TYPE_CHECKING, Any

from gazelle.compat.ros_version import message_ros_version
from gazelle.compat.unsupported.modules import UnsupportedModuleFinder
from gazelle.compat.unsupported.placeholders import PlaceholderFinder

if TYPE_CHECKING:
    from importlib.abc import Loader
else:

    class Loader:
        """What `importlib.abc` has, which no node needs at its start, nor what that imports."""

        def create_module(self, spec: object) -> None:
            """Let Python make the module itself."""


__all__ = ["install"]

_PARTS = ("msg", "srv", "action")
# What message packages hold besides messages.
_EXTRA_MODULES = {"sensor_msgs.point_cloud2": "gazelle.compat.clouds.point_cloud2_ros1"}


def install() -> None:
    """Put the finders behind Python's own, once."""
    if not any(isinstance(item, _WorkspaceFinder) for item in sys.meta_path):
        workspace = _WorkspaceFinder()
        configs = _ConfigFinder(workspace)
        last = UnsupportedModuleFinder()
        sys.meta_path += [workspace, _InterfaceFinder(workspace), configs, last]
        sys.meta_path.insert(0, PlaceholderFinder())


class _WorkspaceFinder:
    """Finds the Python module of a catkin or ament package: ``src/NAME`` or ``NAME`` in it."""

    def __init__(self) -> None:
        self._workspace: Any = None

    def folder(self, name: str) -> Path | None:
        """Return a package's folder, or None; the workspace is crawled on first use."""
        if self._workspace is None:
            from gazelle.workspace import Workspace

            self._workspace = Workspace.discover()
        package = self._workspace.user_package(name)
        return None if package is None else package.path

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,
        target: ModuleType | None = None,
    ) -> ModuleSpec | None:
        if path is not None or fullname.startswith("_"):
            return None
        folder = self.folder(fullname)
        if folder is None:
            return None
        for candidate in (folder / "src" / fullname, folder / fullname):
            file = candidate / "__init__.py"
            if file.is_file():
                loader = TranslatingLoader(fullname, str(file))
                return spec_from_file_location(
                    fullname, file, loader=loader, submodule_search_locations=[str(candidate)]
                )
        return None


class TranslatingLoader(SourceFileLoader):
    """Loads a source file, Python 2 or 3; caches no byte code of translated ones."""

    def source_to_code(  # type: ignore[override]
        self, data: bytes, path: str, *, _optimize: int = -1
    ) -> CodeType:
        """Compile the source, translated when it is Python 2."""
        from gazelle.compat.python2 import compile_source

        return compile_source(bytes(data), path)


class _InterfaceFinder:
    """Makes ``PKG``, ``PKG.msg``, ``PKG.srv`` and ``PKG.action`` out of definitions."""

    def __init__(self, workspace: _WorkspaceFinder) -> None:
        self._workspace = workspace

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,
        target: ModuleType | None = None,
    ) -> ModuleSpec | None:
        if fullname in _EXTRA_MODULES:
            return spec_from_loader(fullname, _ReexportLoader(_EXTRA_MODULES[fullname]))
        package, _, rest = fullname.partition(".")
        part, _, name = rest.partition(".")
        if (part and part not in _PARTS) or not self._defines(package):
            return None
        if name and not name.startswith("_"):
            return None
        if name:
            # genpy's own layout: from std_msgs.msg._String import String
            return spec_from_loader(fullname, _AliasLoader(f"{package}.{part}", name))
        loader = _PartLoader(package, part) if part else _PackageLoader()
        return spec_from_loader(fullname, loader, is_package=True)

    def _defines(self, package: str) -> bool:
        from gazelle.interfaces import add_package, known_types

        if any(known_types(part, package) for part in _PARTS):
            return True
        folder = self._workspace.folder(package)
        if folder is None or not any((folder / part).is_dir() for part in _PARTS):
            return False
        add_package(package, folder)
        return True


class _PackageLoader(Loader):
    def exec_module(self, module: ModuleType) -> None:
        module.__path__ = []


class _AliasLoader(Loader):
    """A module such as ``std_msgs.msg._String``, which holds one class (or a service's three)."""

    def __init__(self, parent: str, name: str) -> None:
        self._parent = parent
        self._name = name.removeprefix("_")

    def exec_module(self, module: ModuleType) -> None:
        parent = import_module(self._parent)
        for suffix in ("", "Request", "Response"):
            name = self._name + suffix
            if name in parent.__all__:
                setattr(module, name, getattr(parent, name))


class _ReexportLoader(Loader):
    """A module that has the public names of another."""

    def __init__(self, source: str) -> None:
        self._source = source

    def exec_module(self, module: ModuleType) -> None:
        source = import_module(self._source)
        module.__all__ = source.__all__  # type: ignore[attr-defined]
        for name in source.__all__:
            setattr(module, name, getattr(source, name))


class _PartLoader(Loader):
    """Fills ``PKG.msg`` on demand: a class is made when it is first asked for."""

    def __init__(self, package: str, part: str) -> None:
        self._package = package
        self._part = part
        self._is_ros1 = True

    def exec_module(self, module: ModuleType) -> None:
        from gazelle.interfaces import known_types

        self._is_ros1 = message_ros_version() == 1
        names = known_types(self._part, self._package)
        exported = [name.rsplit("/", 1)[-1] for name in names]
        if self._part == "srv" and self._is_ros1:
            exported += [f"{name}{half}" for name in exported for half in ("Request", "Response")]
        make = self._make

        def find(name: str) -> Any:
            if name not in exported:
                raise AttributeError(f"module '{module.__name__}' has no attribute '{name}'")
            made = make(name)
            setattr(module, name, made)
            return made

        module.__path__ = []
        module.__all__ = sorted(exported)  # type: ignore[attr-defined]
        module.__getattr__ = find  # type: ignore[method-assign]

    def _make(self, name: str) -> Any:
        from gazelle import interfaces

        full = f"{self._package}/{self._part}/{name}"
        if self._part == "action":
            return interfaces.action_type(full)
        if not self._is_ros1:
            made = interfaces.message_type if self._part == "msg" else interfaces.service_type
            return made(full)
        if self._part == "msg":
            return interfaces.ros1_message_type(f"{self._package}/{name}")
        return self._ros1_service(name)

    def _ros1_service(self, name: str) -> Any:
        from gazelle.interfaces import known_types, ros1_service_type

        names = {item.rsplit("/", 1)[-1] for item in known_types("srv", self._package)}
        if name in names:
            return ros1_service_type(f"{self._package}/{name}")
        for half in ("Request", "Response"):
            if name.endswith(half) and name.removesuffix(half) in names:
                service = ros1_service_type(f"{self._package}/{name.removesuffix(half)}")
                return getattr(service, f"_{half.lower()}_class")
        raise AttributeError(name)


class _ConfigFinder:
    """Finds ``PKG`` (if nobody else does), ``PKG.cfg`` and ``PKG.cfg.NAMEConfig``."""

    def __init__(self, workspace: _WorkspaceFinder) -> None:
        self._workspace = workspace

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,
        target: ModuleType | None = None,
    ) -> ModuleSpec | None:
        package, _, rest = fullname.partition(".")
        part, _, name = rest.partition(".")
        if part not in {"", "cfg"} or fullname.startswith("_"):
            return None
        folder = self._workspace.folder(package)
        files = {} if folder is None else _cfg_files(folder)
        if not files:
            return None
        if not name:
            return spec_from_loader(fullname, _PackageLoader(), is_package=True)
        file = files.get(name.removesuffix("Config")) if name.endswith("Config") else None
        return None if file is None else spec_from_loader(fullname, _ConfigLoader(file))


class _ConfigLoader(Loader):
    """Runs a ``.cfg`` file, which is a Python program, as its package's build does."""

    def __init__(self, file: Path) -> None:
        self._file = file

    def exec_module(self, module: ModuleType) -> None:
        from gazelle.compat.dynamic_reconfigure.encoding import extract_params

        generator, name = self._run()
        description = generator.group.to_dict()
        rows = extract_params(description)
        module.__file__ = str(self._file)
        found: dict[str, Any] = {"config_description": description, "all_level": 0}
        for key, field in (("min", "min"), ("max", "max"), ("defaults", "default")):
            found[key] = {row["name"]: row[field] for row in rows}
        found["level"] = {row["name"]: row["level"] for row in rows}
        found["type"] = {row["name"]: row["type"] for row in rows}
        for row in rows:
            found["all_level"] |= row["level"]
        found |= {f"{name}_{row['name']}": row["value"] for row in generator.constants}
        vars(module).update(found)

    def _run(self) -> tuple[Any, str]:
        from gazelle.compat.dynamic_reconfigure import parameter_generator
        from gazelle.compat.python2 import compile_source

        file = self._file
        finished = parameter_generator.FINISHED
        before = len(finished)
        code = compile_source(file.read_bytes(), str(file))
        names = {"__name__": "__main__", "__file__": str(file), "__builtins__": __builtins__}
        argv, sys.argv = sys.argv, [str(file)]
        try:
            exec(code, names)  # noqa: S102 - a .cfg file is a program of the user's package
        except SystemExit as stop:
            if stop.code not in (None, 0):
                raise ImportError(f"'{file}' ended with {stop.code!r}") from stop
        finally:
            sys.argv = argv
        made = finished[before:]
        del finished[before:]
        if not made:
            raise ImportError(f"'{file}' does not call generate() of its ParameterGenerator")
        return made[-1]


def _cfg_files(folder: Path) -> dict[str, Path]:
    """Return the ``.cfg`` programs of a package by name; a folder ``cfg`` may be a Python one."""
    return {file.stem: file for file in sorted((folder / "cfg").rglob("*.cfg"))}
