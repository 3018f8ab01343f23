"""Which compiler is taken, and what is said where there is none."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cpp.building import toolchain as module
from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain


def fake(folder: Path, name: str, version: str = "c++ (Debian) 12.2.0") -> Path:
    file = folder / name
    file.write_text(f"#!/bin/sh\necho '{version}'\n", encoding="utf-8")
    file.chmod(0o755)
    return file


@pytest.fixture(autouse=True)
def no_memory() -> None:
    module._found.cache_clear()


def test_cxx_names_the_compiler_and_its_first_words(tmp_path: Path) -> None:
    own = fake(tmp_path, "own-g++")
    found = find_toolchain({"CXX": f"{own} -m64", "PATH": ""})
    assert (found.kind, found.command) == ("gcc", (str(own), "-m64"))


def test_the_system_has_a_compiler_before_the_wheel_has(tmp_path: Path) -> None:
    fake(tmp_path, "clang++", "Debian clang version 14.0.6")
    found = find_toolchain({"PATH": str(tmp_path)})
    assert (found.kind, found.command) == ("clang", (str(tmp_path / "clang++"),))


def test_cxx_that_is_nowhere_is_named() -> None:
    with pytest.raises(NoToolchainError, match="CXX names 'nowhere-g\\+\\+'"):
        find_toolchain({"CXX": "nowhere-g++", "PATH": ""})


def test_a_compiler_that_does_not_run_says_why(tmp_path: Path) -> None:
    broken = tmp_path / "c++"
    broken.write_text("#!/bin/sh\necho 'cannot find libisl' >&2\nexit 1\n", encoding="utf-8")
    broken.chmod(0o755)
    with pytest.raises(NoToolchainError, match="cannot find libisl"):
        find_toolchain({"PATH": str(tmp_path)})


def test_without_any_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_zig", lambda: None)
    with pytest.raises(NoToolchainError, match=r"pip install 'gazelle-sim\[cpp\]'"):
        find_toolchain({"PATH": ""})


def test_zig_takes_no_header_of_the_system(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    zig = fake(tmp_path, "zig", "0.13.0")
    monkeypatch.setattr(module, "_zig", lambda: zig)
    found = find_toolchain({"PATH": ""})
    assert found.kind == "zig"
    assert found.system_boost is None
    assert not str(found.eigen or "").startswith("/usr/")
    assert {"-mcpu=baseline", "-fno-sanitize=undefined"} <= {*found.flags}


def test_another_compiler_has_another_key(tmp_path: Path) -> None:
    first, second = fake(tmp_path, "a-g++"), fake(tmp_path, "b-g++", "g++ 13.1")
    keys = {find_toolchain({"CXX": str(one), "PATH": ""}).key for one in (first, second)}
    assert len(keys) == 2
