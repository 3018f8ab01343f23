"""Building C++ packages: one for a workspace's build, or all that a launch is about to start.

A launch's packages are built in the cache, each in a folder of its own, in order of need; only the
programs that are wanted are made of them. CMake and ninja know what has changed.
"""

from __future__ import annotations

import errno
import functools
import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, replace
from pathlib import Path

from gazelle.announcements import announce
from gazelle.cpp.building.cache import cache_top, digest_of_text, only_one, touch
from gazelle.cpp.building.cmake import (
    CMakeRun,
    Target,
    configure,
    install,
    left_out_flags,
    run_ninja,
    targets_of,
)
from gazelle.cpp.building.errors import CppBuildError
from gazelle.cpp.building.findings import report_failures
from gazelle.cpp.building.settings import Unit
from gazelle.cpp.building.toolchain import NoToolchainError, Toolchain, find_toolchain
from gazelle.cpp.host.signal_mask import signals_for_children
from gazelle.cpp.runtime_libraries import HERE
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean, render_text
from gazelle.workspace import Package, Workspace
from gazelle.workspace.building.build import takes_part_in_cpp
from gazelle.workspace.building.compile_step import Compiled, CompileRequest

__all__ = [
    "build_package",
    "ensure_all_built",
    "ensure_built",
    "ensure_installed",
    "ensure_library_built",
]

Wanted = tuple[Package, str, SourceSpan | None]

_MAKES_SOMETHING = re.compile(
    r"^\s*(add_library|add_executable|generate_messages|rosidl_generate_interfaces|"
    r"ament_auto_add_\w+|ament_export_\w+|rosbuild_\w+|rospack_\w+|generate_parameter_library|"
    r"generate_dynamic_reconfigure_options|catkin_package\s*\([^)]*(INCLUDE_DIRS|CFG_EXTRAS)|"
    r"cuda_add_\w+|nodelet_\w+|pybind11_add_module|genmsg|gensrv)\b",
    re.IGNORECASE | re.MULTILINE,
)
_BUILDING = re.compile(r"Building C\w* object")
_CANNOT = 126


def build_package(request: CompileRequest, said: Callable[[str], None] | None = None) -> Compiled:
    """Compile a package of a workspace that is being built, and install what is made.

    Args:
        request: which one and where to.
        said: gets each line of CMake, ninja and the compiler as it comes.
    """
    diagnostics = Diagnostics()
    source = request.package
    unit = _unit_of_request(request)
    output: list[str] = []
    code = 0
    try:
        toolchain = find_toolchain()
        with only_one(request.build / ".gazelle.lock", f"building '{source.name}'"):
            code = _built(unit, toolchain, (), output, diagnostics, said)
            if code == 0 and unit.install is not None:
                run = install(unit, os.environ)
                output += run.lines
                code = run.code
                _remove_left_out(unit)
    except NoToolchainError as error:
        diagnostics.report("cpp.no-compiler", str(error).partition("\n")[0])
        code = _CANNOT
    except CppBuildError as error:
        _report_build_error(error, diagnostics)
        code = 1
    except OSError as error:
        _report_os_error(error, diagnostics)
        code = 1
    return Compiled(code, tuple(output), tuple(render_text(item) for item in diagnostics))


def ensure_built(
    package: Package,
    executable: str,
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    span: SourceSpan | None = None,
    environ: Mapping[str, str] | None = None,
) -> Path | None:
    """Return the file of a program of C++, compiled where it has to be.

    Args:
        package: a source package.
        executable: the program's name.
        workspace: where the packages are that it needs.
        diagnostics: receives why there is none; nothing is raised for it.
        span: where it is asked for.
        environ: environment variables; the process's own when None.
    """
    files = ensure_all_built(
        [(package, executable, span)],
        workspace=workspace,
        diagnostics=diagnostics,
        environ=environ,
    )
    return files.get((package.name, executable))


def ensure_all_built(
    wanted: Sequence[Wanted],
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    environ: Mapping[str, str] | None = None,
) -> dict[tuple[str, str], Path]:
    """Return the files of programs, all compiled on all cores where they have to be.

    Args:
        wanted: packages, names of programs and where they are asked for.
        workspace: where packages are.
        diagnostics: receives what went wrong; what failed is absent from the result.
        environ: environment variables; the process's own when None.
    """
    work = _Work(workspace, diagnostics, os.environ if environ is None else environ)
    for package, executable, span in wanted:
        work.want(package, executable, span)
    return work.done()


def ensure_library_built(
    package: Package,
    library: str,
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    span: SourceSpan | None = None,
    environ: Mapping[str, str] | None = None,
) -> Path | None:
    """Return the file of a library of C++ by its name without ``lib`` and ``.so``."""
    work = _Work(workspace, diagnostics, os.environ if environ is None else environ)
    work.want(package, library, span, is_library=True)
    return work.done().get((package.name, library))


def ensure_installed(
    package: Package,
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    environ: Mapping[str, str] | None = None,
) -> Path | None:
    """Return a prefix with all that C++ makes of a package: for catkin its devel space.

    What of it does not compile is told and absent.
    """
    work = _Work(workspace, diagnostics, os.environ if environ is None else environ)
    work.want(package, "", None)
    work.done()
    unit = work.units.get(package.name)
    if unit is None or package.name in work.failed:
        return None
    return unit.install or unit.devel


def _built(
    unit: Unit,
    toolchain: Toolchain,
    targets: Iterable[str],
    output: list[str],
    diagnostics: Diagnostics,
    said: Callable[[str], object] | None,
    environ: Mapping[str, str] = os.environ,
) -> int:
    """Configure and build; returns an exit code, and what failed is told."""
    run = configure(unit, toolchain, environ, said)
    output += run.lines
    if run.code:
        report_failures(unit, run, diagnostics)
        return run.code
    _tell_left_out(unit, diagnostics)
    _tell_flags(unit, diagnostics)
    run = run_ninja(unit, toolchain, targets, environ, said, unit.jobs)
    output += run.lines
    if run.code:
        report_failures(unit, run, diagnostics)
    return run.code


def _tell_left_out(unit: Unit, diagnostics: Diagnostics) -> None:
    from gazelle.cpp.provided_packages import refusal

    by_package: dict[str, list[str]] = {}
    for target in targets_of(unit):
        if target.refused:
            by_package.setdefault(target.refused, []).append(target.name)
    for name, targets in sorted(by_package.items()):
        named = ", ".join(f"'{target}'" for target in sorted(targets))
        text = f"{unit.name}: {named} left out: {refusal(name, unit.generation) or name}"
        diagnostics.report(
            "cpp.target-left-out", text, SourceSpan(str(unit.path / "CMakeLists.txt"))
        )


def _tell_flags(unit: Unit, diagnostics: Diagnostics) -> None:
    """Say which of the user's flags the compiler does not get."""
    flags = sorted(left_out_flags(unit))
    if flags:
        named = " and ".join(flags)
        text = f"{unit.name}: {named} left out: what is compiled has to fit Gazelle's libraries"
        diagnostics.report("cpp.flag-left-out", text, SourceSpan(str(unit.path / "CMakeLists.txt")))


def _remove_left_out(unit: Unit) -> None:
    """Take the stand-ins of targets that were left out off the install space."""
    names = {target.file.name for target in targets_of(unit) if target.refused}
    if not names or unit.install is None:
        return
    manifest = unit.build / "install_manifest.txt"
    try:
        listed = manifest.read_text(encoding="utf-8").splitlines()
    except OSError:
        listed = []
    for line in listed:
        if Path(line).name in names:
            Path(line).unlink(missing_ok=True)


def _report_build_error(error: CppBuildError, diagnostics: Diagnostics) -> None:
    if error.is_no_room:
        diagnostics.report("cpp.no-room", str(error))
    else:
        diagnostics.report("cpp.compile-error", f"Gazelle's own C++ library: {error}")


def _report_os_error(error: OSError, diagnostics: Diagnostics) -> None:
    # Files that are written in one go have no name in the error.
    where = error.filename or f"{cache_top()}{os.sep}"
    code = "build.cannot-write"
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        code = "cpp.no-room"
    diagnostics.report(code, f"cannot write '{where}': {error.strerror or error}")


def _unit_of_request(request: CompileRequest) -> Unit:
    source = request.package
    manifest = source.manifest
    depends = {
        kind: tuple(item.name for item in manifest.dependencies if item.kind in kinds)
        for kind, kinds in _DEPEND_KINDS.items()
    }
    return Unit(
        name=source.name,
        version=manifest.version,
        path=source.path,
        generation=_generation(source.path, source.build_type),
        build=request.build,
        devel=request.devel or request.build / "devel",
        install=request.install,
        definitions=dict(request.definitions),
        prefixes=request.prefixes,
        empty_packages=(*_empty_packages(request.prefixes), *_without_cpp(request)),
        sources=(*_sources_of(request.prefixes), *(other.path for other in request.others)),
        build_depends=depends["build"],
        buildtool_depends=depends["tool"],
        run_depends=depends["run"],
        jobs=request.jobs,
    )


_DEPEND_KINDS: dict[str, frozenset[str]] = {
    "build": frozenset({"build_depend", "depend"}),
    "tool": frozenset({"buildtool_depend"}),
    "run": frozenset({"exec_depend", "run_depend", "depend"}),
}


def _generation(path: Path, build_type: str) -> int:
    if build_type in ("catkin", "rosbuild"):
        return 1
    if build_type.startswith("ament"):
        return 2
    try:
        text = (path / "CMakeLists.txt").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return 0
    if "catkin" in text or "rosbuild" in text:
        return 1
    return 2 if "ament_" in text or "rclcpp" in text else 0


@functools.cache
def _builtin_names() -> tuple[str, ...]:
    """Return the names of the packages that come with Gazelle, or that it stands in for."""
    folder = HERE.parent / "workspace" / "builtin" / "packages"
    return tuple(sorted(item.name for item in folder.iterdir() if item.is_dir()))


def _empty_packages(prefixes: Iterable[Path]) -> tuple[str, ...]:
    """Return packages that were installed and have nothing of C++, and Gazelle's own."""
    names = dict.fromkeys(_builtin_names())
    for prefix in prefixes:
        for file in sorted(prefix.glob("share/*/package.xml")):
            folder = file.parent
            if (
                not any((folder / "cmake").glob("*onfig.cmake"))
                and not (folder / "cmake" / "gazelle_export.cmake").is_file()
            ):
                names.setdefault(folder.name)
    return tuple(names)


def _without_cpp(request: CompileRequest) -> Iterator[str]:
    """Yield the names of packages of the workspace that give nothing to a compiler but messages."""
    for other in request.others:
        if not takes_part_in_cpp(other, request.definitions):
            yield other.name


def _sources_of(prefixes: Iterable[Path]) -> tuple[Path, ...]:
    return tuple(
        file.parent for prefix in prefixes for file in sorted(prefix.glob("share/*/package.xml"))
    )


@dataclass(frozen=True, slots=True)
class _Request:
    """A program or library that is wanted; an empty name is all of a package."""

    package: Package
    name: str
    span: SourceSpan | None
    is_library: bool


class _Work:
    """All that a launch wants, in order of need."""

    def __init__(
        self, workspace: Workspace, diagnostics: Diagnostics, environ: Mapping[str, str]
    ) -> None:
        self.units: dict[str, Unit] = {}
        self.failed: set[str] = set()
        self._workspace = workspace
        self._diagnostics = diagnostics
        self._environ = environ
        self._requests: list[_Request] = []
        self._packages: dict[str, Package] = {}
        self._needs: dict[str, set[str]] = {}
        self._found: dict[tuple[str, str], Path] = {}
        self._users: dict[str, Package] | None = None
        self._fresh: list[str] = []

    def want(
        self, package: Package, name: str, span: SourceSpan | None, *, is_library: bool = False
    ) -> None:
        """Ask for a program or a library of a package."""
        self._requests.append(_Request(package, name, span, is_library))

    def done(self) -> dict[tuple[str, str], Path]:
        """Build; returns what there is of what was wanted."""
        if not self._requests:
            return {}
        try:
            toolchain = find_toolchain(self._environ)
        except NoToolchainError as error:
            text, _, fix = str(error).partition("\n  fix: ")
            self._diagnostics.report("cpp.no-compiler", text, self._requests[0].span, fix=fix)
            return {}
        for request in self._requests:
            self._add(request.package)
        self._make_units(toolchain)
        self._announce()
        with signals_for_children():
            self._run(toolchain)
        return self._found

    def _add(self, package: Package) -> None:
        """Take in a package and the packages of the workspace that it needs."""
        if package.name in self._packages:
            return
        self._packages[package.name] = package
        self._needs[package.name] = set()
        for name in package.depends:
            other = self._user_packages().get(name)
            if other is not None and other.prefix is None and _has_cmake(other):
                self._add(other)
                self._needs[package.name].add(name)

    def _user_packages(self) -> dict[str, Package]:
        if self._users is None:
            self._users = {item.name: item for item in self._workspace.user_packages}
        return self._users

    def _make_units(self, toolchain: Toolchain) -> None:
        users = self._user_packages()
        empty = tuple(
            name
            for name, item in users.items()
            if name not in self._packages and not (item.prefix is not None and _has_config(item))
        )
        prefixes = {item.prefix for item in users.values() if item.prefix is not None}
        for name, package in self._packages.items():
            generation = _generation(package.path, package.build_type)
            key = digest_of_text(str(package.path), str(generation), toolchain.key, str(HERE))
            top = cache_top() / "packages" / f"{name}-{key}"
            self.units[name] = Unit(
                name=name,
                version=package.version,
                path=package.path,
                generation=generation,
                build=top / "build",
                devel=top / "devel",
                install=None if generation == 1 else top / "install",
                empty_packages=(*_builtin_names(), *empty),
                sources=tuple(item.path for item in users.values()),
                build_depends=package.depends,
                run_depends=package.depends,
                buildtool_depends=("ament_cmake_auto",) if generation == 2 else (),
                prefixes=tuple(sorted(prefixes)),
            )
        for name, unit in self.units.items():
            needed = [self.units[other] for other in sorted(self._all_needs(name))]
            own = tuple(other.install or other.devel for other in needed)
            self.units[name] = replace(unit, prefixes=(*own, *unit.prefixes))

    def _all_needs(self, name: str) -> set[str]:
        found: set[str] = set()
        waiting = [name]
        while waiting:
            for other in self._needs[waiting.pop()] - found:
                found.add(other)
                waiting.append(other)
        return found - {name}

    def _announce(self) -> None:
        self._fresh = [
            name for name, unit in self.units.items() if not (unit.build / "build.ninja").is_file()
        ]
        if self._fresh:
            announce(f"compiling C++ of {', '.join(self._fresh)}")

    def _run(self, toolchain: Toolchain) -> None:
        waiting = dict(self.units)
        running: dict[Future[Diagnostics], str] = {}
        ready: set[str] = set()
        cores = os.cpu_count() or 1
        with ThreadPoolExecutor(max_workers=max(1, cores)) as pool:
            while waiting or running:
                for name in [name for name in waiting if self._needs[name] <= ready]:
                    running[pool.submit(self._build, waiting.pop(name), toolchain)] = name
                if not running:
                    # What is left needs something that is not there, or goes round in circles.
                    self.failed |= set(waiting)
                    return
                done = wait(running, return_when=FIRST_COMPLETED).done
                for future in done:
                    name = running.pop(future)
                    self._diagnostics.extend(future.result())
                    ready.add(name)

    def _build(self, unit: Unit, toolchain: Toolchain) -> Diagnostics:
        """Build what is wanted of a package, all of it where another one needs it."""
        found = Diagnostics()
        touch(unit.build.parent)
        try:
            with only_one(unit.build.parent / "lock", f"compiling '{unit.name}'"):
                self._build_alone(unit, toolchain, found)
        except NoToolchainError as error:
            text, _, fix = str(error).partition("\n  fix: ")
            found.report("cpp.no-compiler", text, fix=fix)
            self.failed.add(unit.name)
        except CppBuildError as error:
            _report_build_error(error, found)
            self.failed.add(unit.name)
        except OSError as error:
            _report_os_error(error, found)
            self.failed.add(unit.name)
        return found

    def _build_alone(self, unit: Unit, toolchain: Toolchain, found: Diagnostics) -> None:
        requests = [item for item in self._requests if item.package.name == unit.name]
        is_needed = any(unit.name in needs for needs in self._needs.values())
        run = configure(unit, toolchain, self._environ)
        if run.code:
            report_failures(unit, run, found)
            self.failed.add(unit.name)
            return
        _tell_left_out(unit, found)
        _tell_flags(unit, found)
        targets = targets_of(unit)
        chosen: dict[_Request, Target] = {}
        for request in requests:
            target = _target_for(request, targets)
            if target is not None and not target.refused:
                chosen[request] = target
            elif request.name and target is None and not request.is_library:
                self._report_no_target(request, targets, found)
        whole = is_needed or any(not item.name for item in requests)
        whole = whole or any(item.is_library and item not in chosen for item in requests)
        names = [] if whole else [target.name for target in chosen.values()]
        if not whole and not names:
            return
        run = self._ninja(unit, toolchain, names, found)
        if whole and unit.install is not None:
            done = install(unit, self._environ, is_partial=run.code != 0)
            if done.code:
                report_failures(unit, done, found)
        for request, target in chosen.items():
            if target.file.is_file() and _is_current(target, unit, run):
                self._found[request.package.name, request.name] = target.file
        if whole:
            self._find_libraries(unit, requests, found)

    def _find_libraries(self, unit: Unit, requests: Sequence[_Request], found: Diagnostics) -> None:
        """Find libraries that no target of their name makes among all that was made."""
        for request in requests:
            key = request.package.name, request.name
            target = _target_for(request, targets_of(unit))
            if not request.is_library or key in self._found or (target and target.refused):
                continue
            tops = (unit.devel, unit.build, *([unit.install] if unit.install else []))
            files = (file for top in tops for file in top.rglob(f"lib{request.name}.so"))
            if file := next(files, None):
                self._found[key] = file
            else:
                self._report_no_target(request, targets_of(unit), found)

    def _ninja(
        self, unit: Unit, toolchain: Toolchain, names: Sequence[str], found: Diagnostics
    ) -> CMakeRun:
        def said(line: str) -> None:
            if unit.name not in self._fresh and _BUILDING.search(line):
                announce(f"compiling C++ of {unit.name} again: something of it has changed")

        run = run_ninja(unit, toolchain, names, self._environ, said)
        if run.code:
            report_failures(unit, run, found)
        return run

    def _report_no_target(
        self, request: _Request, targets: Sequence[Target], found: Diagnostics
    ) -> None:
        kind = "library" if request.is_library else "program"
        names = [
            target.executable
            for target in targets
            if (target.kind == "EXECUTABLE") != request.is_library
        ]
        text = f"CMakeLists.txt of '{request.package.name}' makes no {kind} '{request.name}'"
        found.report("cpp.no-target", text, request.span, fix=did_you_mean(request.name, names))


def _is_current(target: Target, unit: Unit, run: CMakeRun) -> bool:
    """Tell whether a file was made, or found as new as its sources, though others failed."""
    relative = os.path.relpath(target.file, unit.build)
    return not any(
        made in (relative, str(target.file)) or f"/{target.name}.dir/" in f"/{made}"
        for made in run.failures
    )


def _target_for(request: _Request, targets: Sequence[Target]) -> Target | None:
    for target in targets:
        if request.is_library:
            names = {target.name, target.file.stem.removeprefix("lib")}
            if target.kind in ("SHARED_LIBRARY", "MODULE_LIBRARY") and request.name in names:
                return target
        elif target.kind == "EXECUTABLE" and target.executable == request.name:
            return target
    return None


def _has_config(package: Package) -> bool:
    return any((package.path / "cmake").glob("*.cmake"))


def _has_cmake(package: Package) -> bool:
    """Tell whether CMake makes something of a package that others may use."""
    try:
        text = (package.path / "CMakeLists.txt").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return False
    return _MAKES_SOMETHING.search(re.sub(r"#.*", "", text)) is not None
