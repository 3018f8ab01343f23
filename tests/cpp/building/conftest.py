"""Packages of C++ that are built with libraries that hold nothing: only the build is tried."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest

from gazelle.cpp.building import settings as build_settings
from gazelle.cpp.building.runtime import Runtime
from gazelle.cpp.building.toolchain import Toolchain, find_toolchain
from gazelle.cpp.runtime_libraries import with_needs

needs_compiler = pytest.mark.skipif(
    shutil.which("c++") is None or shutil.which("cmake") is None or shutil.which("ninja") is None,
    reason="needs a C++ compiler, CMake and ninja",
)


@pytest.fixture(scope="session")
def stubs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("stubs")


@pytest.fixture
def stub_runtime(stubs: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Stand in for the runtime, which takes a minute to compile; keep packages apart."""

    def ensure(
        names: Sequence[str], generation: int, toolchain: Toolchain | None = None
    ) -> Runtime:
        chosen = toolchain or find_toolchain()
        found = {}
        for row in with_needs(tuple(names)):
            found[row.name] = stubs / row.file_name
            if not found[row.name].is_file():
                empty = [*chosen.c_command, "-shared", "-fPIC", "-xc", "/dev/null"]
                name = f"-Wl,-soname,{row.file_name}"
                subprocess.run([*empty, name, "-o", str(found[row.name])], check=True)
        return Runtime(chosen, generation, found)

    monkeypatch.setattr(build_settings, "ensure_runtime", ensure)
    monkeypatch.setattr("gazelle.cpp.building.build.cache_top", lambda: tmp_path / "cache")
    monkeypatch.setattr("gazelle.cpp.building.cmake.precompiled_table", lambda *_: None)


Packages = Callable[[Mapping[str, str]], Path]


@pytest.fixture
def packages(tmp_path: Path) -> Packages:
    """Return what writes files below a source space, by their paths, and returns it."""

    def write(files: Mapping[str, str]) -> Path:
        top = tmp_path / "ws" / "src"
        for name, text in files.items():
            path = top / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return top

    return write


def manifest(name: str, tool: str = "catkin", *depends: str) -> str:
    """Return a package.xml."""
    rows = "".join(f"<depend>{item}</depend>" for item in depends)
    export = f"<export><build_type>{tool}</build_type></export>"
    return (
        f'<package format="3"><name>{name}</name><version>1.2.3</version>'
        "<description>d</description>"
        f'<maintainer email="a@b.c">a</maintainer><license>MIT</license>'
        f"<buildtool_depend>{tool}</buildtool_depend>{rows}{export}</package>"
    )
