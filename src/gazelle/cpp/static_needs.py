"""What the C++ of a package needs and is not here, found by reading: nothing is compiled.

A header is looked for among Gazelle's own, those of messages, the package's, its workspace's and
the system's. Headers behind an ``#if`` may be meant for others and are not asked for.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

from gazelle.cpp.interfaces.header_names import header_path, snake_name
from gazelle.cpp.provided_packages import provided, refusal
from gazelle.cpp.requirements import refused_header
from gazelle.cpp.runtime_libraries import include_roots
from gazelle.diagnostics import SourceSpan
from gazelle.documents.files import is_file, is_folder
from gazelle.interfaces import RosVersion, known_types
from gazelle.workspace import Package, Workspace
from gazelle.workspace.building.cmake_lists import CMakeLists, Step, read_cmake_lists

__all__ = ["MissingHeader", "MissingPackage", "Needs", "Refused", "needs_of"]

_CPP = (".cpp", ".cc", ".cxx", ".c", ".h", ".hh", ".hpp", ".hxx")
_SOURCES = (".cpp", ".cc", ".cxx", ".c")
_PRUNED = frozenset({"build", "devel", "install", "log", "__pycache__"})
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_LINE = re.compile(r"^[ \t]*#[ \t]*(\w+)[ \t]*([^\n]*)", re.MULTILINE)
_NAME = re.compile(r"[<\"]([^>\"]+)[>\"]")
_TARGETS = (
    "add_executable", "add_library", "ament_auto_add_executable", "ament_auto_add_library",
    "cs_add_executable", "cs_add_library", "rosbuild_add_executable", "rosbuild_add_library",
)  # fmt: skip
_NO_SOURCES = frozenset({"ALIAS", "IMPORTED", "INTERFACE"})
_FIND_WORDS = frozenset(
    {"COMPONENTS", "CONFIG", "EXACT", "MODULE", "NO_MODULE", "OPTIONAL_COMPONENTS", "QUIET",
     "REQUIRED"}
)  # fmt: skip
_SYSTEM = ("/usr/local/include", "/usr/include")
_GENERATED = {
    "generate_export_header": "{0}_export.h",
    "generate_parameter_library": "{0}.hpp",
}
_TYPE_ENDINGS = {"msg": ".msg", "srv": ".srv", "action": ".action"}
_ACTION_PARTS = ("Action", "Goal", "Result", "Feedback", "ActionGoal", "ActionResult",
                 "ActionFeedback")  # fmt: skip


class MissingHeader(NamedTuple):
    """A header that nothing here has.

    Attributes:
        name: as included.
        span: where.
        target: the program or library that cannot be built without it.
    """

    name: str
    span: SourceSpan
    target: str


class MissingPackage(NamedTuple):
    """A package that ``CMakeLists.txt`` requires and nothing here has."""

    name: str
    span: SourceSpan


class Refused(NamedTuple):
    """A program or library that is left out, since it needs what is refused by name.

    Attributes:
        target: its name.
        package: what it needs.
        why: that is not here.
        span: where the target stands.
    """

    target: str
    package: str
    why: str
    span: SourceSpan


class Needs(NamedTuple):
    """What the C++ of a package lacks here.

    Attributes:
        generation: of ROS that the package is for, 1 or 2.
        headers: those that nothing has.
        packages: those that nothing has.
        refused: targets that are left out.
    """

    generation: int = 1
    headers: tuple[MissingHeader, ...] = ()
    packages: tuple[MissingPackage, ...] = ()
    refused: tuple[Refused, ...] = ()


class _Include(NamedTuple):
    name: str
    line: int


def needs_of(package: Package, workspace: Workspace) -> Needs:
    """Return what the C++ of a source package lacks.

    Args:
        package: with a ``CMakeLists.txt``; others need nothing.
        workspace: whose packages have headers and messages, too.
    """
    lists = read_cmake_lists(package.path, package.name)
    if lists is None or not lists.called(*_TARGETS):
        return Needs()
    generation = _generation(package, lists)
    headers = _Headers(package, workspace, generation, lists)
    missing: dict[str, MissingHeader] = {}
    refused: list[Refused] = []
    for step in lists.called(*_TARGETS):
        lacking = list(headers.lacking(step))
        names = (refused_header(item.name, generation) for item in lacking)
        name = next(filter(None, names), "")
        if name:
            why = refusal(name, generation)
            refused.append(Refused(step.arguments[0], name, why, step.span))
            continue
        for item in lacking:
            missing.setdefault(item.name, item)
    packages = _missing_packages(lists, workspace, generation)
    return Needs(generation, tuple(missing.values()), tuple(packages), tuple(refused))


def _generation(package: Package, lists: CMakeLists) -> int:
    if package.ros_version is not None:
        return package.ros_version
    found = {step.arguments[0] for step in lists.called("find_package") if step.arguments}
    return 2 if any(name.startswith(("ament_", "rclcpp")) for name in found) else 1


class _Headers:
    """Where headers are that a package may include."""

    def __init__(
        self, package: Package, workspace: Workspace, generation: int, lists: CMakeLists
    ) -> None:
        self._package = package
        self._workspace = workspace
        self._generation = generation
        self._roots = (*include_roots(generation), *_system_roots())
        self._messages = _message_headers(generation)
        self._made = frozenset(_made_names(lists))
        self._own = _names_below(package.path)
        self._includes: dict[Path, tuple[_Include, ...]] = {}

    def lacking(self, step: Step) -> Iterator[MissingHeader]:
        """Yield the headers that a target's sources, and headers of the package in them, lack."""
        if _NO_SOURCES & set(step.arguments[1:2]):
            return
        waiting = [
            path
            for argument in step.arguments[1:]
            if argument.endswith(_SOURCES) and is_file(path := self._source(step, argument))
        ]
        seen = set(waiting)
        while waiting:
            path = waiting.pop()
            for item in self._included(path):
                own = self._own_header(path, item.name)
                if own is not None:
                    if own not in seen:
                        seen.add(own)
                        waiting.append(own)
                elif not self._is_here(item.name):
                    span = SourceSpan(str(path), item.line)
                    yield MissingHeader(item.name, span, step.arguments[0])

    def _source(self, step: Step, argument: str) -> Path:
        return self._package.path / step.folder / argument

    def _included(self, path: Path) -> tuple[_Include, ...]:
        if path not in self._includes:
            self._includes[path] = tuple(_includes(path))
        return self._includes[path]

    def _own_header(self, path: Path, name: str) -> Path | None:
        beside = path.parent / name
        if is_file(beside):
            return beside
        return self._own.get(name.rpartition("/")[2], {}).get(name)

    def _is_here(self, name: str) -> bool:
        if "/" not in name and "." not in name:
            return True  # of the C++ library
        if name in self._messages or name.rpartition("/")[2] in self._made:
            return True
        if any(is_file(root / name) for root in self._roots):
            return True
        if "/" not in name and not is_file(Path("/usr/include/stdio.h")):
            return True  # of the C library, which a compiler without a system brings
        return self._in_workspace(name)

    def _in_workspace(self, name: str) -> bool:
        top, _, rest = name.partition("/")
        for package in self._workspace.user_packages:
            if package.path == self._package.path:
                continue
            if name in _names_below(package.path).get(name.rpartition("/")[2], {}):
                return True
        found = self._workspace.packages.get(top)
        if found is None or not rest:
            return False
        return name in _headers_of_types(found, self._generation) or any(
            f"{top}/{file.stem}Config.h" == name for file in found.path.glob("cfg/*.cfg")
        )


@cache
def _system_roots() -> tuple[Path, ...]:
    """Return folders of the system's headers, Eigen, OpenCV and PCL's own ones included."""
    from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain

    found = [Path(top) for top in _SYSTEM]
    for top in _SYSTEM:
        if is_folder(Path(top)):
            found += [path for path in sorted(Path(top).iterdir()) if path.is_dir()]
    found += sorted(Path("/usr/lib").glob("gcc/*/*/include"))
    try:
        toolchain = find_toolchain()
    except NoToolchainError:  # told by who asks for a compiler
        return tuple(found)
    found += [path for path in (toolchain.boost, toolchain.eigen) if path is not None]
    return tuple(found)


@cache
def _message_headers(generation: int) -> frozenset[str]:
    version = RosVersion(generation)
    names: set[str] = set()
    for part in _TYPE_ENDINGS:
        for full in known_types(part):
            package, _, name = full.split("/")
            names |= _headers_of(package, part, name, version)
    return frozenset(names)


def _headers_of(package: str, part: str, name: str, version: RosVersion) -> set[str]:
    """Return the headers of a type: an action of ROS 1 has seven, a service three."""
    if version is RosVersion.ROS1 and part == "action":
        return {f"{package}/{name}{ending}.h" for ending in _ACTION_PARTS}
    names = {header_path(f"{package}/{part}/{name}", version)}
    if version is RosVersion.ROS1 and part == "srv":
        names |= {f"{package}/{name}{ending}.h" for ending in ("Request", "Response")}
    if version is RosVersion.ROS2:
        names |= {f"{package}/{part}/{snake_name(name)}.h"}
    return names


def _headers_of_types(package: Package, generation: int) -> set[str]:
    version = RosVersion(generation)
    names: set[str] = set()
    for part, ending in _TYPE_ENDINGS.items():
        for file in package.path.glob(f"**/*{ending}"):
            names |= _headers_of(package.name, part, file.stem, version)
    return names


@cache
def _names_below(folder: Path) -> Mapping[str, Mapping[str, Path]]:
    """Return the headers below a folder by their names and every way to include them."""
    found: dict[str, dict[str, Path]] = {}
    for root, folders, names in os.walk(folder):
        folders[:] = [one for one in folders if one not in _PRUNED and not one.startswith(".")]
        for name in names:
            if not name.endswith(_CPP):
                continue
            path = Path(root, name)
            parts = path.relative_to(folder).parts
            for start in range(len(parts)):
                found.setdefault(name, {}).setdefault("/".join(parts[start:]), path)
    return found


def _made_names(lists: CMakeLists) -> Iterator[str]:
    """Yield the names of headers that the build makes."""
    for step in lists.called(*_GENERATED):
        if step.arguments:
            yield _GENERATED[step.name].format(step.arguments[0])
    for step in lists.called("configure_file"):
        yield from (Path(argument).name for argument in step.arguments[1:2])
    for step in lists.called("add_custom_command"):
        yield from (Path(one).name for one in step.after("OUTPUT", ("COMMAND", "DEPENDS")))


def _includes(path: Path) -> Iterator[_Include]:
    """Yield what a file includes in any case; an ``#ifndef`` around it all is its guard."""
    text = path.read_text(encoding="utf-8", errors="replace")
    text = _COMMENT.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
    depth = 0
    for index, found in enumerate(_LINE.finditer(text)):
        word, rest = found[1], found[2]
        if word in {"if", "ifdef", "ifndef"}:
            is_guard = index == 0 and word == "ifndef"
            depth += 0 if is_guard else 1
        elif word == "endif":
            depth = max(0, depth - 1)
        elif word == "include" and depth == 0:
            name = _NAME.match(rest.strip())
            if name:
                yield _Include(name[1], text.count("\n", 0, found.start(1)) + 1)


def _missing_packages(
    lists: CMakeLists, workspace: Workspace, generation: int
) -> Iterator[MissingPackage]:
    known = provided(generation)
    messages = {name.partition("/")[0] for part in _TYPE_ENDINGS for name in known_types(part)}
    seen: set[str] = set()
    for step in lists.called("find_package"):
        if step.is_conditional or "QUIET" in step.arguments or "REQUIRED" not in step.arguments:
            continue
        names: Iterable[str] = step.arguments[:1]
        if step.arguments[0] == "catkin":
            names = [*names, *step.after("COMPONENTS", _FIND_WORDS)]
        for name in names:
            if name in seen or "${" in name:
                continue
            seen.add(name)
            is_ours = name in known or name in messages or bool(refusal(name, generation))
            is_ours = is_ours or _toolchain_has(name)
            if not is_ours and name not in workspace.packages and not _cmake_has(name):
                yield MissingPackage(name, step.span)


def _toolchain_has(name: str) -> bool:
    """Tell whether the headers of a library come with the compiler, from a wheel or the system."""
    from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain

    try:
        toolchain = find_toolchain()
    except NoToolchainError:  # told by who asks for a compiler
        return name in {"Boost", "Eigen", "Eigen3"}
    if name == "Boost":
        return toolchain.has_boost
    return name in {"Eigen", "Eigen3"} and toolchain.eigen is not None


@cache
def _cmake_has(name: str) -> bool:
    """Tell whether CMake's own modules or configurations on this system know a package."""
    if any(is_file(folder / f"Find{name}.cmake") for folder in _cmake_modules()):
        return True
    for top in ("/usr/local", "/usr"):
        for lib in ("lib", "lib64", "share", f"lib/{os.uname().machine}-linux-gnu"):
            base = Path(top, lib)
            if is_folder(base / name / "cmake"):
                return True
            folders = base.glob("cmake/*")
            if any(one.name.lower().startswith(name.lower()) for one in folders):
                return True
    return False


@cache
def _cmake_modules() -> tuple[Path, ...]:
    """Return the folders of modules of the CMake that builds: a wheel's, or the system's."""
    from importlib.util import find_spec

    from gazelle.cpp.building.toolchain import find_program

    tops: set[Path] = set()
    program = find_program("cmake")
    if program is not None:
        tops |= {program.resolve().parents[1], program.parents[1]}
    spec = find_spec("cmake")
    if spec is not None and spec.submodule_search_locations:
        tops.add(Path(next(iter(spec.submodule_search_locations))) / "data")
    return tuple(path for top in sorted(tops) for path in sorted(top.glob("share/cmake*/Modules")))
