"""A library with codecs of messages of both generations in C++, called by ctypes."""

from __future__ import annotations

import ctypes
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from random import Random
from typing import Any

import pytest

from gazelle.cpp.building.runtime import ensure_runtime
from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain
from gazelle.cpp.interfaces import known_messages, package_messages
from gazelle.cpp.interfaces.header_names import class_name, header_path
from gazelle.cpp.runtime_libraries import HERE
from gazelle.interfaces import RosVersion, TypeStore
from gazelle.interfaces.definition import FORMATS, Array, FieldType, attribute_name
from gazelle.interfaces.ros1_time import Duration, Time

__all__ = ["OWN_PACKAGE", "MessageProbe", "RefusedError", "filled", "own_types"]

OWN_PACKAGE = Path(__file__).parent / "definitions" / "probe_msgs"
_SINK = ctypes.CFUNCTYPE(None, ctypes.POINTER(ctypes.c_uint8), ctypes.c_size_t)
_SOURCE = Path(__file__).with_name("message_probe.cpp")
_LIMITS = {
    "b": (-128, 127),
    "B": (0, 255),
    "h": (-(2**15), 2**15 - 1),
    "H": (0, 2**16 - 1),
    "i": (-(2**31), 2**31 - 1),
    "I": (0, 2**32 - 1),
    "q": (-(2**63), 2**63 - 1),
    "Q": (0, 2**64 - 1),
}


class RefusedError(Exception):
    """C++ threw a `gazelle::Error`; its text."""


class MessageProbe:
    """Calls what C++ does with a message of a type.

    Attributes:
        ros_version: whose classes.
        names: full names of the types that it knows.
    """

    def __init__(self, folder: Path, ros_version: RosVersion, names: Sequence[str]) -> None:
        """Write the headers of all that is known, and compile codecs of some.

        Args:
            folder: for headers and the library.
            ros_version: whose classes.
            names: full names.
        """
        try:
            find_toolchain()
        except NoToolchainError as error:
            pytest.skip(str(error))
        self.ros_version = ros_version
        self.names = tuple(names)
        include = folder / f"ros{ros_version.value}"
        known_messages(ros_version.value, include)
        files = sorted(file for file in OWN_PACKAGE.rglob("*") if file.suffix in _PARTS)
        package_messages(OWN_PACKAGE, ros_version.value, include, files)
        self._library = self._compiled(include, folder)

    def cdr(self, name: str, data: bytes) -> bytes:
        """Return CDR that C++ has read and written again."""
        return self._call(name, 0, data)

    def ros1_of(self, name: str, data: bytes) -> bytes:
        """Return the bytes of ROS 1 of a message that is CDR."""
        return self._call(name, 1, data)

    def cdr_of(self, name: str, data: bytes) -> bytes:
        """Return the CDR of a message that is in ROS 1's bytes."""
        return self._call(name, 2, data)

    def definition(self, name: str) -> str:
        """Return the whole text of a type."""
        return self._call(name, 3).decode()

    def yaml(self, name: str, data: bytes, *, flow: bool = False) -> str:
        """Return a message that is CDR as ROS 2's C++ prints it."""
        return self._call(name, 5 if flow else 4, data).decode()

    def printed(self, name: str, data: bytes) -> str:
        """Return a message that is CDR as ROS 1's C++ prints it."""
        return self._call(name, 6, data).decode()

    def default(self, name: str) -> bytes:
        """Return the CDR of a new message."""
        return self._call(name, 7)

    def sums(self, name: str) -> tuple[str, ...]:
        """Return type, name in ROS 1, MD5 sum and hash."""
        return tuple(self._call(name, 8).decode().split("\n"))

    def _call(self, name: str, what: int, data: bytes = b"") -> bytes:
        said: list[bytes] = []
        sink = _SINK(lambda start, size: said.append(ctypes.string_at(start, size)))
        code = self._library.probe(name.encode(), what, data, len(data), sink)
        assert code != 1, f"{name} is not in the probe"
        if code == 2:
            raise RefusedError(said[0].decode())
        return said[0]

    def _compiled(self, include: Path, folder: Path) -> ctypes.CDLL:
        paths = sorted({header_path(name, self.ros_version) for name in self.names})
        lines = [f"#include <{path}>" for path in paths]
        rows = [
            f'  {{"{name}", &gazelle::message_type<{class_name(name, self.ros_version)}>}},'
            for name in self.names
        ]
        source = folder / f"probe{self.ros_version.value}.cpp"
        text = _SOURCE.read_text(encoding="utf-8")
        text = text.replace("// INCLUDES", "\n".join(lines)).replace("// ROWS", "\n".join(rows))
        source.write_text(text, encoding="utf-8")
        output = folder / f"libprobe{self.ros_version.value}.so"
        own = HERE / "include" / f"ros{self.ros_version.value}"
        roots = [f"-f=-isystem{path}" for path in (own, include)]
        command = [sys.executable, "-m", "gazelle.cpp.compile", str(source), "-o", str(output)]
        command += ["--ros", "0", "--shared", "-f=-O0", *roots]
        done = subprocess.run(command, check=False, capture_output=True)
        assert done.returncode == 0, done.stderr.decode()
        for library in ensure_runtime(["core"], 0).libraries.values():
            ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)
        return ctypes.CDLL(str(output))


_PARTS = (".msg", ".srv", ".action")


def own_types() -> TypeStore:
    """Return a store that knows the messages of these tests."""
    types = TypeStore()
    types.add_package("probe_msgs", OWN_PACKAGE)
    return types


def filled(types: TypeStore, name: str, ros_version: RosVersion, random: Random) -> Any:
    """Return a message with values of chance that its wire can hold."""
    message = types.class_of(name, ros_version)()
    for item in types.definition(name, ros_version).fields:
        kind = item.type
        if kind.array is Array.ONE:
            value = _single(types, kind, ros_version, random)
        else:
            most = kind.size or 9
            count = kind.size if kind.array is Array.FIXED else random.choice((0, 1, 2, most))
            value = [_single(types, kind, ros_version, random) for _ in range(count)]
            if ros_version is RosVersion.ROS1 and kind.base in ("uint8", "char"):
                value = bytes(value)
        setattr(message, attribute_name(item.name), value)
    return message


def _single(types: TypeStore, kind: FieldType, ros_version: RosVersion, random: Random) -> Any:
    if kind.is_message:
        return filled(types, kind.base, ros_version, random)
    if kind.is_string:
        count = random.randrange(min(8, kind.string_bound or 8))
        return "".join(random.choice("aZ09 _/") for _ in range(count))
    if kind.base == "time":
        return Time(random.randrange(2**31), random.randrange(10**9))
    if kind.base == "duration":
        return Duration(random.randrange(-(2**31), 2**31), random.randrange(10**9))
    if kind.base == "bool":
        return random.random() < 0.5
    letter = FORMATS[kind.base]
    if kind.base == "byte" and ros_version is RosVersion.ROS1:
        return random.randrange(128)  # signed here, unsigned on the graph
    if letter in "fd":
        return float(random.randrange(-(2**20), 2**20)) / 64.0
    return random.randint(*_LIMITS[letter])
