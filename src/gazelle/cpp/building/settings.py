"""What our CMake files are told of a package, a compiler and the libraries that are there.

It is one file of ``set()`` commands in the package's build folder, and one of JSON beside it for
the commands that CMake calls. Both change only when something in them does, so CMake is run again
just then.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.cpp.building.messages import known_messages
from gazelle.cpp.building.node_file import node_objects
from gazelle.cpp.building.programs import launcher, programs
from gazelle.cpp.building.runtime import Runtime, ensure_runtime, roots_of
from gazelle.cpp.building.toolchain import Toolchain
from gazelle.cpp.provided_packages import (
    REFUSED,
    REFUSED_BEGINNINGS,
    REFUSED_IN_ROS2,
    provided,
)
from gazelle.cpp.runtime_libraries import HERE, LIBRARIES, with_needs

__all__ = ["Unit", "library_rows", "quoted", "write_if_changed", "write_settings"]

CMAKE = HERE / "cmake"
_MAIN_LIBRARY = {0: "core", 1: "roscpp", 2: "rclcpp"}


@dataclass(frozen=True, slots=True)
class Unit:
    """A package that is built by CMake of its own.

    Attributes:
        name: of the package.
        version: as its manifest says.
        path: of its sources.
        generation: 1 or 2 of ROS; 0 for plain CMake.
        build: CMake's folder.
        devel: where programs, libraries and generated headers of catkin go.
        install: prefix, None to install nothing.
        definitions: variables for ``CMakeLists.txt``.
        prefixes: spaces of packages built before it.
        empty_packages: names of packages that are there and give nothing to C++.
        sources: folders of other packages whose messages it may use.
        build_depends: names it needs to be built.
        buildtool_depends: names of its build tools.
        run_depends: names it needs when it runs.
        jobs: compilers at a time, 0 for as many as there are cores.
    """

    name: str
    version: str
    path: Path
    generation: int
    build: Path
    devel: Path
    install: Path | None = None
    definitions: Mapping[str, str] = field(default_factory=dict)
    prefixes: tuple[Path, ...] = ()
    empty_packages: tuple[str, ...] = ()
    sources: tuple[Path, ...] = ()
    build_depends: tuple[str, ...] = ()
    buildtool_depends: tuple[str, ...] = ()
    run_depends: tuple[str, ...] = ()
    jobs: int = 0

    @property
    def settings(self) -> Path:
        """The file that CMake reads."""
        return self.build / "gazelle_settings.cmake"


def write_settings(unit: Unit, toolchain: Toolchain, libraries: Sequence[str]) -> None:
    """Write both files of a package; compiles the libraries named where they are not there.

    Args:
        unit: the package.
        toolchain: what compiles it.
        libraries: runtime libraries that it will be linked with, as far as is known.
    """
    names = sorted({"core", _MAIN_LIBRARY[unit.generation], *libraries})
    runtime = ensure_runtime(names, unit.generation, toolchain)
    memory = {
        "generation": unit.generation,
        "package": unit.name,
        "path": str(unit.path),
        "libraries": names,
        "sources": [str(path) for path in unit.sources],
    }
    text = json.dumps(memory, indent=1)
    write_if_changed(unit.settings.with_suffix(".json"), text)
    write_if_changed(unit.settings, _text(unit, toolchain, runtime))


def write_if_changed(file: Path, text: str) -> None:
    """Write a text, unless that is what the file holds."""
    try:
        if file.read_text(encoding="utf-8") == text:
            return
    except OSError:
        file.parent.mkdir(parents=True, exist_ok=True)
    spare = file.with_name(f"{file.name}.{os.getpid()}")
    spare.write_text(text, encoding="utf-8")
    spare.replace(file)


def _text(unit: Unit, toolchain: Toolchain, runtime: Runtime) -> str:
    rows: dict[str, Iterable[str] | str] = {}
    rows |= _of_compiler(unit, toolchain, runtime)
    rows |= _of_package(unit)
    rows |= _of_packages(unit)
    rows |= library_rows(runtime)
    rows |= _of_boost(toolchain)
    lines = [f"set({name} {quoted(value)})" for name, value in rows.items()]
    return "# Written by Gazelle; read by its CMake files.\n" + "\n".join(lines) + "\n"


def quoted(value: Iterable[str] | str) -> str:
    """Return a value, or several, as one argument of CMake."""
    text = value if isinstance(value, str) else ";".join(value)
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("$", "\\$") + '"'


def library_rows(runtime: Runtime) -> dict[str, Iterable[str] | str]:
    """Return the variable of each library: its file, and those of what it needs."""
    return {
        f"GAZELLE_LIBRARY_{name}": [
            str(runtime.libraries[row.name]) for row in reversed(with_needs((name,)))
        ]
        for name in runtime.libraries
    }


def _of_compiler(
    unit: Unit, toolchain: Toolchain, runtime: Runtime
) -> dict[str, Iterable[str] | str]:
    cxx, cc, archiver, ranlib = programs(toolchain)
    roots = [str(root) for root in roots_of(unit.generation).values()] if unit.generation else []
    folders = [str(folder) for folder in (toolchain.boost, toolchain.eigen) if folder]
    first = [flag for flag in toolchain.flags if flag in ("-O2", "-g1") or flag.startswith("-std=")]
    last = [flag for flag in toolchain.flags if flag not in first]
    if toolchain.kind != "zig":
        # Words that CXX has after the compiler's name.
        first = [*toolchain.command[1:], *first]
    c_first = [flag for flag in first if not flag.startswith("-std=")]
    c_last = [flag for flag in last if not flag.startswith(("-D", "-fno-gnu"))]
    main = runtime.libraries[_MAIN_LIBRARY[unit.generation]]
    always = ["-Wl,--as-needed", str(main), str(runtime.libraries["core"]), "-lpthread", "-ldl"]
    return {
        "GAZELLE_CXX": cxx,
        "GAZELLE_CC": cc,
        "GAZELLE_AR": archiver,
        "GAZELLE_RANLIB": ranlib,
        "GAZELLE_LAUNCHER": str(launcher(toolchain)),
        "GAZELLE_INCLUDE_DIRS": [*roots, *folders],
        "GAZELLE_HEADERS": roots[0] if roots else "",
        "GAZELLE_FIRST_FLAGS": " ".join(first),
        "GAZELLE_LAST_FLAGS": " ".join(last),
        "GAZELLE_FIRST_C_FLAGS": " ".join(c_first),
        "GAZELLE_LAST_C_FLAGS": " ".join(c_last),
        "GAZELLE_NODE_OBJECTS": " ".join(_word(path) for path in node_objects(toolchain)),
        "GAZELLE_ALWAYS_LINKED": " ".join(always),
        "GAZELLE_IS_ROS": "1" if unit.generation else "",
        "GAZELLE_ROS": str(unit.generation),
    }


def _word(path: Path) -> str:
    text = str(path)
    return f"'{text}'" if " " in text else text


def _of_package(unit: Unit) -> dict[str, Iterable[str] | str]:
    info = sys.version_info
    return {
        "GAZELLE_PACKAGE_NAME": unit.name,
        "GAZELLE_PACKAGE_VERSION": unit.version,
        "GAZELLE_DEVEL": str(unit.devel),
        "GAZELLE_EXPORT_FILE": str(
            unit.devel / "share" / unit.name / "cmake" / "gazelle_export.cmake"
        ),
        "GAZELLE_BUILD_DEPENDS": unit.build_depends,
        "GAZELLE_BUILDTOOL_DEPENDS": unit.buildtool_depends,
        "GAZELLE_RUN_DEPENDS": unit.run_depends,
        "GAZELLE_PYTHON": sys.executable,
        "GAZELLE_PYTHON_COMMAND": [sys.executable, "-m", "gazelle.cpp.building.cmake_calls"],
        "GAZELLE_SITE_PACKAGES": f"lib/python{info.major}.{info.minor}/site-packages",
        "GAZELLE_EMPTY_SOURCE": str(CMAKE / "left_out.cpp"),
        "GAZELLE_CATKIN_LIBRARIES": (),
    }


def _of_packages(unit: Unit) -> dict[str, Iterable[str] | str]:
    rows: dict[str, Iterable[str] | str] = {}
    known = provided(unit.generation) if unit.generation else {}
    names = dict.fromkeys(known)
    for row in known.values():
        libraries = [name for name in row.libraries if name in LIBRARIES]
        rows[f"GAZELLE_LIBRARIES_OF_{row.name}"] = libraries
        rows[f"GAZELLE_TARGETS_OF_{row.name}"] = row.targets
        rows[f"GAZELLE_SCRIPTS_OF_{row.name}"] = row.scripts
    exported = {
        file.parents[1].name: str(file)
        for prefix in unit.prefixes
        for file in sorted(prefix.glob("share/*/cmake/gazelle_export.cmake"))
    }
    exported.pop(unit.name, None)
    if unit.generation:
        messages = known_messages(unit.generation)
        names |= dict.fromkeys(item.name for item in sorted(messages.iterdir()) if item.is_dir())
        names |= dict.fromkeys(unit.empty_packages)
        for name in names:
            if name not in known:
                rows[f"GAZELLE_LIBRARIES_OF_{name}"] = [_MAIN_LIBRARY[unit.generation]]
        refused = dict(REFUSED) | (dict(REFUSED_IN_ROS2) if unit.generation == 2 else {})
        rows |= {f"GAZELLE_REFUSED_{name}": why for name, why in refused.items()}
        rows["GAZELLE_REFUSED_BEGINNINGS"] = list(REFUSED_BEGINNINGS)
        rows |= {f"GAZELLE_REFUSED_BEGINNING_{a}": why for a, why in REFUSED_BEGINNINGS.items()}
        for name in refused:
            names.pop(name, None)
    own = {name for name in exported if name in names}
    rows["GAZELLE_PROVIDED"] = [name for name in names if name not in own and name != unit.name]
    rows |= {f"GAZELLE_EXPORT_{name}": file for name, file in exported.items()}
    return rows


def _of_boost(toolchain: Toolchain) -> dict[str, Iterable[str] | str]:
    rows: dict[str, Iterable[str] | str] = {
        "GAZELLE_OWN_BOOST": "1",
        "GAZELLE_BOOST_DIR": str(toolchain.boost or toolchain.system_boost or ""),
        "GAZELLE_BOOST_VERSION": toolchain.boost_version,
        "GAZELLE_EIGEN_DIR": str(toolchain.eigen or ""),
    }
    for name, file in toolchain.boost_libraries.items():
        rows[f"GAZELLE_BOOST_FILES_{name}"] = str(file)
    if "thread" not in toolchain.boost_libraries:
        rows["GAZELLE_BOOST_LIBRARIES_thread"] = "boost_thread"
    return rows
