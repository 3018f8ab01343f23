"""Which of a user's flags the compiler gets."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from tests.cpp.building.conftest import needs_compiler

from gazelle.cpp.building.programs import launcher
from gazelle.cpp.building.toolchain import find_toolchain

pytestmark = needs_compiler


@pytest.fixture(scope="module")
def words_program() -> Path:
    return launcher(find_toolchain())


def passed(words_program: Path, *words: str, table: Path | None = None) -> list[str]:
    environ = {**os.environ, **({"GAZELLE_PRECOMPILED": str(table)} if table else {})}
    command = [str(words_program), "printf", "%s\\n", *words]
    return subprocess.run(
        command, env=environ, capture_output=True, text=True, check=True
    ).stdout.split()


@pytest.mark.parametrize("old", ["c++98", "c++0x", "c++11", "gnu++11", "c++14", "gnu++1y"])
def test_old_standards_are_lifted(words_program: Path, old: str) -> None:
    assert passed(words_program, f"-std={old}") == ["-std=gnu++17"]


@pytest.mark.parametrize("kept", ["-std=c++17", "-std=c++20", "-std=gnu++2b", "-O3", "-DNDEBUG"])
def test_what_fits_is_kept(words_program: Path, kept: str) -> None:
    assert passed(words_program, kept) == [kept]


@pytest.mark.parametrize(
    "flag", ["-march=native", "-mtune=native", "-Werror", "-Werror=return-type"]
)
def test_what_does_not_fit_is_left_out(words_program: Path, flag: str) -> None:
    assert passed(words_program, "-O1", flag, "-g") == ["-O1", "-g"]


def test_a_source_of_the_table_gets_its_header_first(words_program: Path, tmp_path: Path) -> None:
    table = tmp_path / "table"
    table.write_text("/ws/a.cpp\t/cache/ros.hpp\n", encoding="utf-8")
    with_header = passed(words_program, "-c", "/ws/a.cpp", table=table)
    # `printf` prints its format for what comes first as well.
    assert "-fpch-deps" not in passed(words_program, "-c", "/ws/b.cpp", table=table)
    assert with_header != passed(words_program, "-c", "/ws/b.cpp", table=table)
