"""Which sources get the compiled header, and for which flags it is compiled."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from gazelle.cpp.building import precompiled as build_precompiled
from gazelle.cpp.building.precompiled import precompiled_table
from gazelle.cpp.building.settings import Unit
from gazelle.cpp.building.toolchain import Toolchain

GCC = Toolchain("gcc", ("g++",), ("gcc",), "g++ 12", None, None, None, "key")
USUAL = "g++ -std=gnu++17 -O2 -g1 -DROS_BUILD_SHARED_LIBS=1 {flags} -fPIC -o x.o -c {source}"


class Package:
    """A package with one source."""

    def __init__(self, top: Path, made: list[tuple[str, ...]]) -> None:
        self.unit = Unit("one", "1", top / "one", 1, top / "build", top / "devel")
        self.made = made
        for folder in (self.unit.path / "src", self.unit.path / "include", self.unit.build):
            folder.mkdir(parents=True)

    def rows(self, text: str, flags: str = "", count: int = 1) -> int:
        """Return how many of a package's sources get a header."""
        commands = []
        for number in range(count):
            source = self.unit.path / "src" / f"node{number}.cpp"
            source.write_text(text, encoding="utf-8")
            own = f"-I{self.unit.path / 'include'} {flags}"
            command = USUAL.format(flags=own, source=source)
            commands.append({"file": str(source), "command": command, "directory": "/"})
        file = self.unit.build / "compile_commands.json"
        file.write_text(json.dumps(commands), encoding="utf-8")
        table = precompiled_table(self.unit, GCC)
        return 0 if table is None else len(table.read_text(encoding="utf-8").splitlines())


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Package:
    made: list[tuple[str, ...]] = []

    def header(
        toolchain: Toolchain, generation: int, flags: tuple[str, ...] = (), *, make: bool = True
    ) -> Path | None:
        if make:
            made.append(flags)
        return Path("/cache/gazelle_ros1.hpp") if make else None

    monkeypatch.setattr(build_precompiled, "precompiled_header", header)
    return Package(tmp_path, made)


@pytest.mark.parametrize(
    "text",
    [
        "#include <ros/ros.h>\nint main() {}\n",
        '#include "ros/ros.h"\n',
        "// words\n/* more\n   words */\n#include <vector>\n#include <ros/ros.h>\n",
        "#pragma once\n#include <ros/ros.h>\n",
        "#ifndef GUARD\n#define GUARD\n#include <ros/ros.h>\n#endif\n",
    ],
)
def test_a_source_that_begins_with_it_gets_it(package: Package, text: str) -> None:
    assert package.rows(text) == 1


@pytest.mark.parametrize(
    "text",
    [
        "int main() {}\n",
        "#define ROSCONSOLE_MIN_SEVERITY 3\n#include <ros/ros.h>\n",
        "namespace own {}\n#include <ros/ros.h>\n",
    ],
)
def test_a_source_that_may_mean_something_else_does_not(package: Package, text: str) -> None:
    assert package.rows(text) == 0


def test_headers_of_the_package_are_looked_into(package: Package) -> None:
    (package.unit.path / "include" / "own.h").write_text("#include <ros/ros.h>\n", "utf-8")
    assert package.rows("#include <own.h>\nint main() {}\n") == 1


@pytest.mark.parametrize("flags", ["-std=c++11", "-march=native -std=gnu++14", "-Wall -DOWN=1"])
def test_flags_that_change_nothing_share_it(package: Package, flags: str) -> None:
    assert package.rows("#include <ros/ros.h>\n", flags) == 1
    assert package.made == [()]


def test_other_flags_have_to_be_worth_it(package: Package) -> None:
    assert package.rows("#include <ros/ros.h>\n", "-O3 -DNDEBUG") == 0
    assert package.rows("#include <ros/ros.h>\n", "-O3 -DNDEBUG", count=4) == 4
    assert package.made == [("-O3", "-DNDEBUG")]


def test_only_gcc_falls_back_where_flags_differ(package: Package) -> None:
    package.rows("#include <ros/ros.h>\n")
    assert precompiled_table(package.unit, replace(GCC, kind="clang")) is None
