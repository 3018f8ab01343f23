"""Building packages one after the other, or side by side."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from gazelle.diagnostics import SourceSpan, render_text
from gazelle.workspace.building.cmake_lists import read_cmake_lists
from gazelle.workspace.building.cmake_plan import gives_to_cpp, has_compiled_targets, plan_cmake
from gazelle.workspace.building.compile_step import Compiled, CompileRequest, CompileStep
from gazelle.workspace.building.install import install
from gazelle.workspace.building.packages import SourcePackage, needed_by
from gazelle.workspace.building.plan import Layout, Plan, site_packages
from gazelle.workspace.building.python_plan import plan_python
from gazelle.workspace.building.setup_scripts import add_package_scripts

__all__ = [
    "BUILD_TYPES",
    "BuildOptions",
    "Outcome",
    "build_package",
    "needs_compiler",
    "run_jobs",
    "takes_part_in_cpp",
]

BUILD_TYPES = ("ament_cmake", "ament_python", "catkin", "cmake")
"""The build types that there are rules for."""

_CMAKE_CODE, _PYTHON_CODE = 2, 1


@dataclass(frozen=True, slots=True)
class BuildOptions:
    """How packages are built.

    Attributes:
        build_base: records of what was installed go here.
        install_base: install space.
        merged: all packages get one prefix.
        symlinks: link to the sources in place of copying them.
        definitions: variables for ``CMakeLists.txt``.
        prefixes: spaces of packages that were built before, first wins.
    """

    build_base: Path
    install_base: Path
    merged: bool = False
    symlinks: bool = False
    definitions: Mapping[str, str] = field(default_factory=dict)
    prefixes: tuple[Path, ...] = ()

    def prefix(self, name: str) -> Path:
        """Return a package's install prefix."""
        return self.install_base if self.merged else self.install_base / name


class Outcome(NamedTuple):
    """How the build of a package ended.

    Attributes:
        name: of the package.
        code: exit code, 0 for success.
        duration_s: wall time.
        output: what was done, line by line.
        errors: findings, rendered, for standard error.
    """

    name: str
    code: int
    duration_s: float
    output: tuple[str, ...] = ()
    errors: tuple[str, ...] = ()


def build_package(
    package: SourcePackage, options: BuildOptions, compile_step: CompileStep | None = None
) -> Outcome:
    """Install a package below its prefix; nothing is installed when a rule of it cannot be met.

    Args:
        package: what to build.
        options: where to and how.
        compile_step: what compiles; without it compiled code is left out and told.
    """
    begin = time.monotonic()
    plan, layout = Plan(), Layout(options.prefix(package.name), site_packages(), options.symlinks)
    if package.build_type == "ament_python":
        plan_python(package, layout, plan)
    elif package.build_type in BUILD_TYPES:
        compiles = compile_step is not None
        plan_cmake(package, layout, options.definitions, plan, compiles=compiles)
    else:
        _report_type(package, plan)
    code = 0
    output: tuple[str, ...] = ()
    compiled = Compiled()
    if plan.diagnostics.errors:
        code = _PYTHON_CODE if package.build_type == "ament_python" else _CMAKE_CODE
    elif compile_step is not None and takes_part_in_cpp(package, options.definitions):
        # Before the rest: what it installs too is linked afterwards where links are wanted.
        compiled = compile_step(
            CompileRequest(
                package,
                build=options.build_base / package.name,
                install=layout.prefix,
                definitions=options.definitions,
                prefixes=options.prefixes,
            )
        )
        code = compiled.code
    if not code:
        add_package_scripts(package, layout, plan)
        name = "install_manifest.txt" if compiled == Compiled() else "gazelle_manifest.txt"
        record = options.build_base / package.name / name
        try:
            output = tuple(install(plan.items.values(), layout, record).lines)
        except OSError as error:
            text = f"cannot write '{error.filename}': {error.strerror}"
            plan.diagnostics.report("build.cannot-write", text)
            code = _CMAKE_CODE
    output = (*compiled.output, *output)
    errors = (*compiled.errors, *(render_text(item) for item in plan.diagnostics))
    return Outcome(package.name, code, time.monotonic() - begin, output, errors)


def needs_compiler(package: SourcePackage, definitions: Mapping[str, str]) -> bool:
    """Tell whether a package has C++ to compile, or libraries of headers alone."""
    lists = read_cmake_lists(package.path, package.name, definitions)
    return lists is not None and has_compiled_targets(lists)


def takes_part_in_cpp(package: SourcePackage, definitions: Mapping[str, str]) -> bool:
    """Tell whether a package has C++, or messages and the like of which C++ needs headers."""
    lists = read_cmake_lists(package.path, package.name, definitions)
    return lists is not None and gives_to_cpp(lists)


def run_jobs(
    packages: Sequence[SourcePackage],
    work: Callable[[SourcePackage], Outcome],
    *,
    everything: Sequence[SourcePackage],
    workers: int,
    started: Callable[[str], None],
    ended: Callable[[Outcome], None],
    continue_on_error: bool = False,
) -> tuple[str, ...]:
    """Run work for packages, each after those it needs.

    Args:
        packages: in order.
        work: called in threads.
        everything: all packages of the workspace, for needs by way of others.
        workers: how many at a time.
        started: told the name of a package whose work begins.
        ended: told the outcome; both are called in this thread.
        continue_on_error: go on with packages that need none that failed.

    Returns:
        The names of packages that were not processed.
    """
    waiting = {item.name: item for item in packages}
    chosen = frozenset(waiting)
    needs = {name: (needed_by([name], everything) & chosen) - {name} for name in waiting}
    done: set[str] = set()
    running: set[Future[Outcome]] = set()
    failed = False
    with ThreadPoolExecutor(max_workers=max(1, workers)) as pool:
        while True:
            free = [name for name in waiting if needs[name] <= done]
            if failed and not continue_on_error:
                free = []
            for name in free[: max(1, workers) - len(running)]:
                started(name)
                running.add(pool.submit(work, waiting.pop(name)))
            if not running:
                return tuple(waiting)
            finished = wait(running, return_when=FIRST_COMPLETED).done
            for outcome in sorted(future.result() for future in finished):
                failed = failed or outcome.code != 0
                if outcome.code == 0:
                    done.add(outcome.name)
                ended(outcome)
            running -= finished


def _report_type(package: SourcePackage, plan: Plan) -> None:
    known = ", ".join(BUILD_TYPES)
    text = f"No task extension to 'build' a 'ros.{package.build_type}' package; there are rules for"
    span = SourceSpan(str(package.path / "package.xml"))
    plan.diagnostics.report("build.unknown-type", f"{text} {known}", span)
