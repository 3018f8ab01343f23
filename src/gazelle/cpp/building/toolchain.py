"""Which compiler there is, where Boost and Eigen are, and the flags that everything is compiled by.

The system's compiler comes first: ``CXX``, then ``c++``, ``g++``, ``clang++``. Without one it is
zig's, of the wheel ``ziglang``, which brings its own C++ library: then Boost and Eigen are those of
wheels as well, for nothing of the system's C++ may be mixed with it. All that is compiled is kept
below the toolchain's key, so two compilers never share an object.
"""

from __future__ import annotations

import hashlib
import os
import platform
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Literal

from gazelle.errors import GazelleError

__all__ = ["INSTALL_HINT", "NoToolchainError", "Toolchain", "find_program", "find_toolchain"]

INSTALL_HINT = "pip install 'gazelle-sim[cpp]'"

_COMPILERS = ("c++", "g++", "clang++")
_EIGEN_FLAG = "-DEIGEN_MAX_ALIGN_BYTES=16"
"""Alignment of Eigen's fixed-size types is part of every interface: one for all objects."""

_COMMON_FLAGS = (
    "-std=gnu++17",
    "-fPIC",
    "-O2",
    "-g1",
    "-ffp-contract=off",
    "-pthread",
    _EIGEN_FLAG,
    "-D_GLIBCXX_USE_DEPRECATED=1",
    "-DBOOST_BIND_GLOBAL_PLACEHOLDERS",
    "-DBOOST_ERROR_CODE_HEADER_ONLY",
    "-DBOOST_SYSTEM_NO_LIB",
    "-DBOOST_ALL_NO_LIB",
    "-DBOOST_CHRONO_HEADER_ONLY",
    "-DBOOST_ALLOW_DEPRECATED_HEADERS",
)


def _zig_target() -> tuple[str, ...]:
    """Name this machine to zig: for a machine that has a name it takes no headers of the system."""
    if sys.platform != "linux":
        return ()
    kind = "gnu" if platform.libc_ver()[0] == "glibc" else "musl"
    return ("-target", f"{platform.machine()}-linux-{kind}")


ZIG_FLAGS = (*_zig_target(), "-mcpu=baseline", "-fno-sanitize=undefined")
"""Of every call, for zig builds its C++ library anew for other ones."""

Kind = Literal["gcc", "clang", "zig"]


class NoToolchainError(GazelleError):
    """Nothing here compiles C++, or builds what is compiled; says what to install."""


@dataclass(frozen=True)
class Toolchain:
    """A compiler and the headers that belong with it.

    Attributes:
        kind: of compiler.
        command: the C++ compiler; more than one word for zig.
        c_command: the C compiler.
        version: first line that the compiler says of itself.
        boost: include folder of Boost, None where it is among the system's.
        eigen: include folder of Eigen, None where there is none.
        system_boost: where the system's Boost is, if that one is used.
        key: digest of all of it, in the path of everything compiled.
    """

    kind: Kind
    command: tuple[str, ...]
    c_command: tuple[str, ...]
    version: str
    boost: Path | None
    eigen: Path | None
    system_boost: Path | None
    key: str

    @property
    def has_boost(self) -> bool:
        """Whether there are headers of Boost."""
        return self.boost is not None or self.system_boost is not None

    @cached_property
    def boost_version(self) -> str:
        """Boost's version as CMake writes it, ``1.74.0``; empty without Boost."""
        top = self.boost or self.system_boost
        if top is None:
            return ""
        text = (top / "boost" / "version.hpp").read_text(encoding="utf-8", errors="replace")
        found = re.search(r"#define\s+BOOST_VERSION\s+(\d+)", text)
        number = int(found[1]) if found else 0
        return f"{number // 100000}.{number // 100 % 1000}.{number % 100}"

    @cached_property
    def boost_libraries(self) -> Mapping[str, Path]:
        """The system's libraries of just the Boost whose headers are used, by component."""
        if self.boost is not None or self.system_boost is None:
            return {}
        found: dict[str, Path] = {}
        for folder in _system_library_folders():
            for file in sorted(folder.glob(f"libboost_*.so.{self.boost_version}")):
                found.setdefault(file.name.split(".")[0].removeprefix("libboost_"), file)
        return found

    @property
    def link_command(self) -> tuple[str, ...]:
        """The words of the linker."""
        return (*self.command, *ZIG_FLAGS) if self.kind == "zig" else self.command

    @cached_property
    def flags(self) -> tuple[str, ...]:
        """Flags of every object, the user's and ours."""
        own = {
            "gcc": ("-fno-gnu-unique",),
            "clang": (),
            "zig": ZIG_FLAGS,
        }[self.kind]
        return (*_COMMON_FLAGS, *own)

    @cached_property
    def include_flags(self) -> tuple[str, ...]:
        """Flags naming the folders of Boost and Eigen."""
        folders = (self.boost, self.eigen)
        return tuple(word for folder in folders if folder for word in ("-isystem", str(folder)))


def find_toolchain(environ: Mapping[str, str] = os.environ) -> Toolchain:
    """Return the toolchain of this machine.

    Raises:
        NoToolchainError: there is no compiler, or ``CXX`` names one that cannot be run.
    """
    return _found(environ.get("CXX", ""), environ.get("CC", ""), environ.get("PATH", ""))


def find_program(name: str, environ: Mapping[str, str] = os.environ) -> Path | None:
    """Return ``cmake`` or ``ninja``: a wheel's beside this Python, else the system's."""
    beside = Path(sys.executable).with_name(name)
    if os.access(beside, os.X_OK):
        return beside
    found = shutil.which(name, path=environ.get("PATH", ""))
    return Path(found) if found else None


@lru_cache(maxsize=8)
def _found(cxx: str, cc: str, path: str) -> Toolchain:
    if cxx.strip():
        words = shlex.split(cxx)
        program = shutil.which(words[0], path=path)
        if program is None:
            raise NoToolchainError(f"CXX names '{words[0]}', and there is no such program")
        command = (program, *words[1:])
        return _described(command, _c_compiler(command, cc, path))
    for name in _COMPILERS:
        if program := shutil.which(name, path=path):
            return _described((program,), _c_compiler((program,), cc, path))
    zig = _zig()
    if zig is not None:
        return _described((str(zig), "c++"), (str(zig), "cc"))
    raise NoToolchainError(
        "there is no C++ compiler here (looked for CXX, c++, g++, clang++ and the wheel 'ziglang')"
        f"\n  fix: {INSTALL_HINT}"
    )


def _zig() -> Path | None:
    spec = find_spec("ziglang")
    if spec is None or not spec.submodule_search_locations:
        return None
    program = Path(next(iter(spec.submodule_search_locations))) / (
        "zig.exe" if sys.platform == "win32" else "zig"
    )
    return program if program.is_file() else None


def _c_compiler(command: tuple[str, ...], cc: str, path: str) -> tuple[str, ...]:
    if cc.strip():
        return tuple(shlex.split(cc))
    name = Path(command[0]).name
    if Path(command[0]).stem == "zig":
        return (command[0], "cc")
    partner = name.replace("clang++", "clang").replace("g++", "gcc").replace("c++", "cc")
    beside = Path(command[0]).with_name(partner)
    if os.access(beside, os.X_OK):
        return (str(beside), *command[1:])
    for other in (partner, "cc", "gcc", "clang"):
        if found := shutil.which(other, path=path):
            return (found, *command[1:])
    return (*command, "-xc")


def _described(command: tuple[str, ...], c_command: tuple[str, ...]) -> Toolchain:
    version = _version(command)
    kind: Kind = "gcc"
    if Path(command[0]).stem == "zig":
        kind = "zig"
    elif "clang" in version.lower():
        kind = "clang"
    boost = None if kind != "zig" and _system_boost() is not None else _boost_of_wheel()
    system_boost = None if boost is not None or kind == "zig" else _system_boost()
    eigen = _eigen(of_system=kind != "zig")
    words = (kind, command, c_command, version, str(boost), str(eigen), _stamp(command[0]))
    text = repr((*words, platform.machine(), _COMMON_FLAGS, ZIG_FLAGS if kind == "zig" else ()))
    key = hashlib.sha256(text.encode(errors="surrogateescape")).hexdigest()[:12]
    return Toolchain(kind, command, c_command, version, boost, eigen, system_boost, key)


def _version(command: tuple[str, ...]) -> str:
    try:
        done = subprocess.run(
            [*command, "--version"], capture_output=True, text=True, timeout=60, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise NoToolchainError(f"cannot run the C++ compiler '{command[0]}': {error}") from error
    if done.returncode:
        why = (done.stderr or done.stdout).strip()
        raise NoToolchainError(f"the C++ compiler '{command[0]}' does not run: {why}")
    return done.stdout.partition("\n")[0].strip()


def _stamp(program: str) -> tuple[str, int]:
    real = Path(program).resolve()
    return str(real), real.stat().st_size


def _system_boost() -> Path | None:
    tops = (Path("/usr/local/include"), Path("/usr/include"))
    return next((top for top in tops if (top / "boost" / "version.hpp").is_file()), None)


def _system_library_folders() -> list[Path]:
    triple = f"{platform.machine()}-linux-gnu"
    places = ("/usr/local/lib", f"/usr/lib/{triple}", "/usr/lib64", "/usr/lib")
    return [Path(place) for place in places if Path(place).is_dir()]


def _boost_of_wheel() -> Path | None:
    spec = find_spec("boost_headers")
    if spec is None or not spec.submodule_search_locations:
        return None
    folder = Path(next(iter(spec.submodule_search_locations))) / "include"
    return folder if (folder / "boost" / "version.hpp").is_file() else None


def _eigen(*, of_system: bool) -> Path | None:
    places: list[Path] = []
    if of_system:
        places += [Path("/usr/local/include/eigen3"), Path("/usr/include/eigen3")]
    spec = find_spec("cmeel")
    if spec is not None and spec.origin:
        places.append(Path(spec.origin).parents[1] / "cmeel.prefix" / "include" / "eigen3")
    return next((place for place in places if (place / "Eigen" / "Core").is_file()), None)
