"""Catkin's devel and install spaces: what is put there, and the files a shell sources."""

from __future__ import annotations

import os
import shlex
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from gazelle.diagnostics import SourceSpan, render_text
from gazelle.workspace.building.build import Outcome, takes_part_in_cpp
from gazelle.workspace.building.cmake_plan import (
    add_catkin,
    add_interfaces,
    compiled_targets,
    plan_cmake,
    read_lists,
)
from gazelle.workspace.building.compile_step import Compiled, CompileRequest, CompileStep
from gazelle.workspace.building.install import install
from gazelle.workspace.building.install_rules import cmake_rules
from gazelle.workspace.building.packages import SourcePackage
from gazelle.workspace.building.plan import Layout, Plan, add_rules
from gazelle.workspace.building.setup_scripts import (
    FUNCTIONS,
    HEADER,
    forget,
    own_prefix,
    prepend,
    source_file,
    underlays,
)

__all__ = [
    "COMPILED_DEVEL_RECORD",
    "CatkinSpaces",
    "build_catkin_package",
    "write_space_scripts",
]

_OF_COMPILED = "gazelle_"
_DEVEL_RECORD = "devel_manifest.txt"
COMPILED_DEVEL_RECORD = f"{_OF_COMPILED}{_DEVEL_RECORD}"
"""File in the build folder of a package with C++; as old as the sources that it was built from."""

_PYTHON = "lib/python3/dist-packages"
_PROFILE = "etc/catkin/profile.d"
_DIR = "_CATKIN_SETUP_DIR"
_FOLDERS = (
    ("LD_LIBRARY_PATH", "lib"),
    ("PATH", "bin"),
    ("PKG_CONFIG_PATH", "lib/pkgconfig"),
    ("PYTHONPATH", _PYTHON),
)
_NO_SUCH_SCRIPT = "catkin_install_python: '{path}' does not exist"


class CatkinSpaces(NamedTuple):
    """The folders of a catkin workspace."""

    source: Path
    build: Path
    devel: Path
    install: Path


def build_catkin_package(
    package: SourcePackage,
    spaces: CatkinSpaces,
    definitions: Mapping[str, str],
    *,
    installs: bool,
    compile_step: CompileStep | None = None,
    workspace: Sequence[SourcePackage] = (),
) -> Outcome:
    """Put a package's scripts, modules and hooks into the devel space; install it when asked to.

    Args:
        package: what to build.
        spaces: of the workspace.
        definitions: variables for ``CMakeLists.txt``.
        installs: also do what ``make install`` does.
        compile_step: what compiles; without it compiled code is left out and told.
        workspace: all of its packages.
    """
    begin, begin_ns = time.monotonic(), time.time_ns()
    compiles = compile_step is not None
    devel = Layout(spaces.devel, _PYTHON, symlinks=True)
    plans = [(Plan(), devel, _DEVEL_RECORD)]
    _plan_devel(package, devel, definitions, plans[0][0], compiles=compiles)
    if installs and not plans[0][0].diagnostics.errors:
        layout = Layout(spaces.install, _PYTHON)
        plans.append((Plan(), layout, "install_manifest.txt"))
        plan_cmake(package, layout, definitions, plans[1][0], compiles=compiles)
        plans[1][0].diagnostics.extend(plans[0][0].diagnostics)
    found = plans[-1][0].diagnostics
    code, lines = (1 if found.errors else 0), []
    compiled = Compiled()
    if compile_step is not None and not code and takes_part_in_cpp(package, definitions):
        compiled = compile_step(
            CompileRequest(
                package,
                build=spaces.build / package.name,
                devel=spaces.devel,
                install=spaces.install if installs else None,
                definitions=definitions,
                prefixes=(spaces.devel,),
                others=tuple(item for item in workspace if item.name != package.name),
            )
        )
        code = compiled.code
    for plan, layout, record in plans if not code else []:
        # CMake has a file of the plain name.
        name = record if compiled == Compiled() else f"{_OF_COMPILED}{record}"
        try:
            file = spaces.build / package.name / name
            done = install(plan.items.values(), layout, file)
            # What is changed meanwhile is newer than what was built.
            os.utime(file, ns=(begin_ns, begin_ns))
        except OSError as error:
            text = f"cannot write '{error.filename}': {error.strerror}"
            found.report("build.cannot-write", text)
            code = 1
            break
        lines += done.lines if layout is not devel else []
    errors = (*compiled.errors, *(render_text(item) for item in found))
    output = (*compiled.output, *lines)
    return Outcome(package.name, code, time.monotonic() - begin, output, errors)


def write_space_scripts(space: Path, sources: tuple[Path, ...], environ: Mapping[str, str]) -> None:
    """Write ``setup.*``, ``local_setup.*``, ``env.sh`` and ``.catkin`` of a space.

    Args:
        space: the devel or install space.
        sources: source spaces that a devel space stands for; none for an install space.
        environ: environment variables; workspaces that are sourced in it are sourced first.

    Raises:
        OSError: they cannot be written.
    """
    space.mkdir(parents=True, exist_ok=True)
    (space / ".catkin").write_text(";".join(map(str, sources)), encoding="utf-8")
    below = underlays(environ, ("CMAKE_PREFIX_PATH",), space)
    chain = "".join(source_file(f"{path}/local_setup.sh") for path in below)
    for shell in ("sh", "bash", "zsh"):
        own = own_prefix(_DIR, shell, str(space))
        text = HEADER + own + _body(space, sources, shell) + forget([_DIR])
        (space / f"local_setup.{shell}").write_text(text, encoding="utf-8")
        keep = f'_gazelle_setup="${_DIR}"\nunset {_DIR}\n'
        after = f'{_DIR}="$_gazelle_setup"\n. "$_gazelle_setup/local_setup.{shell}"\n'
        text = HEADER + own + keep + chain + after + forget(["_gazelle_setup"])
        (space / f"setup.{shell}").write_text(text, encoding="utf-8")
    run = f'#!/bin/sh\n{HEADER}{_DIR}="$(cd "$(dirname "$0")" > /dev/null && pwd)"\n'
    run += f'. "${_DIR}/setup.sh"\nexec "$@"\n'
    (space / "env.sh").write_text(run, encoding="utf-8")
    (space / "env.sh").chmod(0o755)


def _plan_devel(
    package: SourcePackage,
    layout: Layout,
    definitions: Mapping[str, str],
    plan: Plan,
    *,
    compiles: bool,
) -> None:
    if not (package.path / "CMakeLists.txt").is_file():
        text = f"package '{package.name}' has no CMakeLists.txt: it is used from its source folder,"
        span = SourceSpan(str(package.path / "package.xml"))
        code = "package.no-build-file"
        plan.diagnostics.report(code, f"{text} where catkin_make would stop", span)
        return
    lists = read_lists(package, plan, definitions)
    if lists is None:
        return
    scripts = [
        rule
        for rule in cmake_rules(lists, f"share/{package.name}").rules
        if any(rule.span == step.span for step in lists.called("catkin_install_python"))
    ]
    add_rules(plan, package.path, scripts, _NO_SUCH_SCRIPT)
    if not compiles:
        compiled_targets(package, lists, plan)
    # Messages are read from the source space; only what is wrong with them counts here.
    add_interfaces(package, lists, Plan(diagnostics=plan.diagnostics))
    add_catkin(package, lists, layout, plan)


def _body(space: Path, sources: tuple[Path, ...], shell: str) -> str:
    lines = [FUNCTIONS, prepend("CMAKE_PREFIX_PATH", _DIR, "")]
    for variable, folder in _FOLDERS:
        lines.append(f'if [ -d "${_DIR}/{folder}" ]; then\n')
        lines.append(f"  {prepend(variable, _DIR, folder)}fi\n")
    for source in reversed(sources):
        lines.append(f"_gazelle_prepend ROS_PACKAGE_PATH {shlex.quote(str(source))}\n")
    if not sources:
        lines.append(prepend("ROS_PACKAGE_PATH", _DIR, "share"))
    hooks = sorted(path.name for path in (space / _PROFILE).glob("*.*"))
    endings = (".sh", f".{shell}")
    for name in [name for name in hooks if os.path.splitext(name)[1] in endings]:  # noqa: PTH122
        lines.append(f'CATKIN_ENV_HOOK_WORKSPACE="${_DIR}"\n')
        lines.append(source_file(f"${_DIR}/{_PROFILE}/{name}"))
    return "".join([*lines, "unset CATKIN_ENV_HOOK_WORKSPACE\n"])
