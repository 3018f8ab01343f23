"""Running CMake and ninja for a package, and what came of it."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.cpp.building.precompiled import precompiled_table
from gazelle.cpp.building.settings import CMAKE, Unit, write_if_changed, write_settings
from gazelle.cpp.building.toolchain import INSTALL_HINT, NoToolchainError, Toolchain, find_program
from gazelle.cpp.provided_packages import provided
from gazelle.cpp.runtime_libraries import HERE, LIBRARIES

__all__ = [
    "CMakeRun",
    "Target",
    "configure",
    "install",
    "left_out_flags",
    "run_ninja",
    "targets_of",
]

_OLDEST = (3, 24)
"""CMake's dependency providers came with it."""

_TRIES = 4
_SOURCES = (".c", ".cc", ".cpp", ".cxx", ".h", ".hh", ".hpp", ".hxx", ".inl", ".ipp")
_LEFT_OUT = re.compile(r"(?<=\s)-(?:m(?:arch|tune|cpu)=native|Werror(?:=[\w-]+)?)(?=[\s\"])")

_INSTALLED = re.compile(r"(file\(INSTALL DESTINATION \"[^\"]*\" TYPE \w+)(?! OPTIONAL)")

Said = Callable[[str], object]


@dataclass(frozen=True, slots=True)
class Target:
    """A target that CMake has made of a package.

    Attributes:
        kind: ``EXECUTABLE``, ``SHARED_LIBRARY``, …
        name: of the target.
        file: what it makes.
        refused: the package that it uses and that is left out, empty for others.
    """

    kind: str
    name: str
    file: Path
    refused: str = ""

    @property
    def executable(self) -> str:
        """The program's name, which OUTPUT_NAME may have changed."""
        return self.file.name


@dataclass(slots=True)
class CMakeRun:
    """How a step went.

    Attributes:
        code: exit code.
        lines: all that was printed.
        failures: the compiler's words for each thing that failed, by what it was to make.
    """

    code: int
    lines: list[str] = field(default_factory=list)
    failures: dict[str, str] = field(default_factory=dict)


def configure(
    unit: Unit, toolchain: Toolchain, environ: Mapping[str, str], said: Said | None = None
) -> CMakeRun:
    """Let CMake read a package, where it has not, or where something of it has changed.

    Raises:
        NoToolchainError: there is no CMake, no ninja, or one that is too old.
        CppBuildError: a runtime library does not compile.
    """
    cmake, ninja = _programs(environ)
    write_settings(unit, toolchain, _libraries_named(unit, toolchain))
    command = [
        str(cmake), "-S", str(unit.path), "-B", str(unit.build), "-G", "Ninja",
        f"-DCMAKE_MAKE_PROGRAM={ninja}",
        f"-DCMAKE_TOOLCHAIN_FILE={CMAKE / 'toolchain.cmake'}",
        f"-DCMAKE_PROJECT_TOP_LEVEL_INCLUDES={CMAKE / 'provider.cmake'}",
        f"-DGAZELLE_SETTINGS={unit.settings}",
        "-DCMAKE_POLICY_VERSION_MINIMUM=3.5", "-Wno-dev", "--no-warn-unused-cli",
        f"-DCMAKE_PREFIX_PATH={';'.join(map(str, unit.prefixes))}",
    ]  # fmt: skip
    if unit.install is not None:
        command.append(f"-DCMAKE_INSTALL_PREFIX={unit.install}")
    command += [f"-D{name}={value}" for name, value in unit.definitions.items()]
    stamp = unit.build / "gazelle_command.txt"
    text = "\n".join(command)
    if _same(stamp, text) and (unit.build / "build.ninja").is_file():
        # Ninja knows which files CMake has read, and asks it again where one has changed.
        run = _run([str(ninja), "-C", str(unit.build), "build.ninja"], environ, unit, said)
        run.failures.clear()
        return run
    run = _run(command, environ, unit, said)
    if run.code == 0:
        write_if_changed(stamp, text)
    return run


def run_ninja(
    unit: Unit,
    toolchain: Toolchain,
    targets: Iterable[str],
    environ: Mapping[str, str],
    said: Said | None = None,
    jobs: int = 0,
) -> CMakeRun:
    """Build targets, all where none is named; what does not compile stops nothing else.

    What was written to while the compiler read it is compiled again.
    """
    _, ninja = _programs(environ)
    command = [str(ninja), "-C", str(unit.build), "-k", "0", *targets]
    command += ["-j", str(jobs)] if jobs else []
    variables = dict(environ)
    table = precompiled_table(unit, toolchain)
    if table is not None:
        variables["GAZELLE_PRECOMPILED"] = str(table)
    for _ in range(_TRIES):
        before = _signatures(unit.path)
        run = _run(command, variables, unit, said)
        changed = [
            path for path, state in _signatures(unit.path).items() if before.get(path) != state
        ]
        if not changed:
            break
        _forget_objects(unit, ninja, changed)
    return run


def _signatures(top: Path) -> dict[str, tuple[int, int]]:
    found: dict[str, tuple[int, int]] = {}
    for root, folders, names in os.walk(top):
        folders[:] = [name for name in folders if not name.startswith(".")]
        for name in names:
            if name.endswith(_SOURCES):
                path = os.path.join(root, name)  # noqa: PTH118 - thousands of them
                try:
                    state = os.stat(path)  # noqa: PTH116
                except OSError:
                    continue
                found[path] = (state.st_mtime_ns, state.st_size)
    return found


def _forget_objects(unit: Unit, ninja: Path, changed: Sequence[str]) -> None:
    """Remove the objects that were made of files which changed meanwhile."""
    listed = subprocess.run(
        [str(ninja), "-C", str(unit.build), "-t", "deps"],
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    ).stdout
    made, names = "", set(changed)
    for line in listed.splitlines():
        if line and not line.startswith(" "):
            made = line.partition(": #deps")[0]
        elif line.strip() in names:
            (unit.build / made).unlink(missing_ok=True)


def left_out_flags(unit: Unit) -> set[str]:
    """Return the flags of a package that ``runtime/tools/compiler_words.c`` takes out."""
    try:
        text = (unit.build / "compile_commands.json").read_text(encoding="utf-8")
    except OSError:
        return set()
    return set(_LEFT_OUT.findall(text))


def install(
    unit: Unit,
    environ: Mapping[str, str],
    said: Said | None = None,
    *,
    is_partial: bool = False,
) -> CMakeRun:
    """Do what ``cmake --install`` does.

    Args:
        unit: the package.
        environ: environment variables.
        said: gets each line.
        is_partial: install what there is of it; otherwise the first file that is absent ends it.
    """
    if is_partial:
        for script in unit.build.rglob("cmake_install.cmake"):
            text = script.read_text(encoding="utf-8")
            changed = _INSTALLED.sub(r"\1 OPTIONAL", text)
            if changed != text:
                script.write_text(changed, encoding="utf-8")
    cmake, _ = _programs(environ)
    return _run([str(cmake), "--install", str(unit.build)], environ, unit, said)


def targets_of(unit: Unit) -> list[Target]:
    """Return the targets of a package that has been configured."""
    try:
        text = (unit.build / "gazelle_targets.txt").read_text(encoding="utf-8")
    except OSError:
        return []
    found = []
    for line in text.splitlines():
        kind, name, file, refused, *_ = [*line.split("\t"), "", "", ""]
        found.append(Target(kind, name, Path(file), refused))
    return found


def _programs(environ: Mapping[str, str]) -> tuple[Path, Path]:
    cmake, ninja = find_program("cmake", environ), find_program("ninja", environ)
    absent = [name for name, path in (("CMake", cmake), ("ninja", ninja)) if path is None]
    if cmake is None or ninja is None:
        raise NoToolchainError(
            f"there is no {' and no '.join(absent)} here, which C++ is built with\n"
            f"  fix: {INSTALL_HINT}"
        )
    version = _version(cmake)
    if version < _OLDEST:
        raise NoToolchainError(
            f"'{cmake}' is CMake {version[0]}.{version[1]}; it takes 3.24 or later\n"
            f"  fix: {INSTALL_HINT}"
        )
    return cmake, ninja


_versions: dict[Path, tuple[int, int]] = {}


def _version(cmake: Path) -> tuple[int, int]:
    if cmake not in _versions:
        done = subprocess.run(
            [str(cmake), "--version"], capture_output=True, text=True, check=False
        )
        found = re.search(r"(\d+)\.(\d+)", done.stdout)
        _versions[cmake] = (int(found[1]), int(found[2])) if found else (0, 0)
    return _versions[cmake]


def _same(file: Path, text: str) -> bool:
    try:
        return file.read_text(encoding="utf-8") == text
    except OSError:
        return False


def _libraries_named(unit: Unit, toolchain: Toolchain) -> list[str]:
    """Return the runtime libraries of the packages that a package's CMake files name."""
    words: set[str] = {*unit.build_depends}
    for file in (unit.path / "CMakeLists.txt", *unit.path.glob("cmake/*.cmake")):
        try:
            text = file.read_text(encoding="utf-8", errors="replace")
        except OSError:
            continue
        words |= set(re.findall(r"[A-Za-z][\w-]*", re.sub(r"#.*", "", text)))
    known = provided(unit.generation) if unit.generation else {}
    found = {library for name in words if name in known for library in known[name].libraries}
    if {"Boost", "thread"} <= words and "thread" not in toolchain.boost_libraries:
        found.add("boost_thread")
    return sorted(found & set(LIBRARIES))


def _environment(environ: Mapping[str, str], unit: Unit) -> dict[str, str]:
    variables = dict(environ)
    # CMake calls this Python with the modules of this very Gazelle.
    own = str(HERE.parents[1])
    if HERE.parents[1].name != "site-packages":
        variables["PYTHONPATH"] = os.pathsep.join(
            filter(None, (own, variables.get("PYTHONPATH", "")))
        )
    variables["ROS_ROOT"] = str(CMAKE / "ros_root")
    variables["ROS_PACKAGE_PATH"] = variables.get("ROS_PACKAGE_PATH", "")
    if unit.generation:
        variables["ROS_VERSION"] = str(unit.generation)
        variables["ROS_DISTRO"] = variables.get("ROS_DISTRO") or (
            "noetic" if unit.generation == 1 else "humble"
        )
    variables["LC_ALL"] = "C"
    variables["NINJA_STATUS"] = "[%f/%t] "
    variables.pop("CMAKE_GENERATOR", None)
    variables.pop("CMAKE_TOOLCHAIN_FILE", None)
    return variables


_STATUS = re.compile(r"^\[\d+/\d+\] ")


def _run(
    command: Sequence[str], environ: Mapping[str, str], unit: Unit, said: Said | None
) -> CMakeRun:
    run = CMakeRun(0)
    with (
        _children_heard(),
        subprocess.Popen(
            command,
            env=_environment(environ, unit),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
        ) as process,
    ):
        assert process.stdout is not None
        for line in process.stdout:
            text = line.rstrip("\n")
            run.lines.append(text)
            if said is not None:
                said(text)
        run.code = process.wait()
    run.failures = _failures(run.lines)
    return run


@contextmanager
def _children_heard() -> Iterator[None]:
    """Let what this thread starts hear of its own children, as CMake has to.

    Threads of nodes hold signals, and a program inherits that: a nodelet that is loaded is
    compiled in such a thread.
    """
    if sys.platform == "win32":
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGCHLD})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _failures(lines: Sequence[str]) -> dict[str, str]:
    """Return what ninja printed of each thing that it could not make, without the command."""
    found: dict[str, str] = {}
    place = 0
    while place < len(lines):
        line = lines[place]
        place += 1
        if not line.startswith("FAILED: "):
            continue
        made = line.removeprefix("FAILED: ").removeprefix("[code=1] ").strip()
        # The command stands in the next line.
        place += 1
        words: list[str] = []
        while place < len(lines):
            if _STATUS.match(lines[place]) or lines[place].startswith(("FAILED: ", "ninja: ")):
                break
            words.append(lines[place])
            place += 1
        found[made] = "\n".join(words)
    return found
