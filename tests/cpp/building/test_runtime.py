"""A process gets the libraries that its node was compiled with, one of each."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import pytest
from tests.cpp.building.conftest import needs_compiler

from gazelle.cpp.building import runtime as build_runtime
from gazelle.cpp.building.cache import forget_unused
from gazelle.cpp.building.runtime import Runtime, libraries_for
from gazelle.cpp.building.toolchain import find_toolchain

pytestmark = needs_compiler


def library(folder: Path, name: str, *needs: Path, headers: str, toolchain: str) -> Path:
    """Make a shared library with a record of what it was made of."""
    folder.mkdir(parents=True)
    file = folder / name
    words = [f"-Wl,-soname,{name}", *map(str, needs), *(f"-Wl,-rpath,{n.parent}" for n in needs)]
    command = ["cc", "-shared", "-fPIC", "-xc", "/dev/null", "-xnone", "-o", str(file)]
    subprocess.run([*command, "-Wl,--no-as-needed", *words], check=True)
    record = {"headers": headers, "toolchain": toolchain, "needs": [str(n) for n in needs]}
    (folder / "made_of.json").write_text(json.dumps(record), encoding="utf-8")
    return file


class World:
    """Libraries of today and of before, and nodes that are linked with either."""

    def __init__(self, top: Path) -> None:
        key = find_toolchain().key
        self.core = library(
            top / "new" / "core", "libgazelle_core.so", headers="new", toolchain=key
        )
        self.tf2 = library(
            top / "new" / "tf2", "libgazelle_tf2.so", self.core, headers="new", toolchain=key
        )
        self.old_core = library(
            top / "old" / "core", "libgazelle_core.so", headers="old", toolchain=key
        )
        self.old_tf2 = library(
            top / "old" / "tf2", "libgazelle_tf2.so", self.old_core, headers="old", toolchain=key
        )
        self.of_clang = library(
            top / "clang" / "core", "libgazelle_core.so", headers="new", toolchain="another"
        )
        self.top = top

    def node(self, name: str, *needs: Path) -> Path:
        return library(self.top / name, name, *needs, headers="", toolchain="")


@pytest.fixture
def world(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> World:
    made = World(tmp_path)
    today = {"core": made.core, "tf2": made.tf2}
    monkeypatch.setattr(build_runtime, "_in_process", {})
    monkeypatch.setattr(build_runtime, "headers_key", lambda _: "new")
    monkeypatch.setattr(
        build_runtime, "ensure_runtime", lambda *_: Runtime(find_toolchain(), 0, today)
    )
    return made


def test_a_node_of_today_gets_todays(world: World) -> None:
    assert libraries_for(world.node("node", world.tf2)) == [world.core, world.tf2]


def test_a_node_of_other_headers_keeps_its_own(world: World) -> None:
    assert libraries_for(world.node("node", world.old_tf2)) == [world.old_core, world.old_tf2]


def test_a_node_of_another_compiler_keeps_its_own(world: World) -> None:
    assert libraries_for(world.node("node", world.of_clang)) == [world.of_clang]


def test_libraries_of_the_user_are_looked_into(world: World) -> None:
    own = world.node("libown.so", world.tf2)
    assert libraries_for(world.node("node", own)) == [world.core, world.tf2]


def test_a_process_keeps_what_it_has_loaded(world: World) -> None:
    libraries_for(world.node("node", world.tf2))
    assert libraries_for(world.node("plugin", world.old_tf2)) == [world.core, world.tf2]


def test_a_node_whose_libraries_are_gone_gets_todays(world: World) -> None:
    node = world.node("node", world.old_core)
    world.old_core.unlink()
    assert libraries_for(node) == [world.core]


def test_what_nobody_used_for_long_is_forgotten(tmp_path: Path) -> None:
    old, new = tmp_path / "lib" / "old", tmp_path / "lib" / "new"
    for folder in (old, new):
        folder.mkdir(parents=True)
    os.utime(old, (0, 0))
    forget_unused(tmp_path)
    assert not old.exists()
    assert new.exists()
