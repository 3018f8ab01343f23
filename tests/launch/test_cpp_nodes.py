"""C++ nodes of a launch of ROS 1: compiled together, before anything starts."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.launch.fake_build import FakeBuild

from gazelle.cpp import provided_programs
from gazelle.diagnostics import Diagnostics
from gazelle.launch.cpp_nodes import find_and_compile
from gazelle.launch.launch_config import LaunchConfig, NodeTag
from gazelle.launch.node_commands import Executable
from gazelle.launch.roslaunch import LaunchOptions, find_executables
from gazelle.workspace import Workspace

Found = tuple[dict[str, Executable], int, Diagnostics]


@pytest.fixture
def build(package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> FakeBuild:
    """Stands in for the compiler; package ``tests_pkg`` has programs one, two, bad."""
    lists = "".join(f"add_executable({name} {name}.cpp)\n" for name in ("one", "two", "bad"))
    (package / "CMakeLists.txt").write_text(lists, encoding="utf-8")
    return FakeBuild.instead_of_compiling(tmp_path, monkeypatch)


@pytest.fixture
def find(package: Path) -> Callable[..., Found]:
    """Finds what runs nodes of these types: by name, how many have nothing, and why."""

    def found(*types: str) -> Found:
        config, diagnostics = LaunchConfig(), Diagnostics()
        config.nodes.extend(
            NodeTag("tests_pkg", one, f"n{number}") for number, one in enumerate(types)
        )
        workspace = Workspace.discover(environ={}, cwd=package)
        nodes, missing = find_executables(config, workspace, diagnostics, LaunchOptions())
        return {spec.name: executable for spec, executable in nodes}, missing, diagnostics

    return found


def test_everything_that_a_launch_starts_is_compiled_at_once(
    build: FakeBuild, find: Callable[..., Found], tmp_path: Path
) -> None:
    nodes, missing, diagnostics = find("one", "does", "two", "one")
    assert build.batches == [["one", "two"]]
    assert missing == 0 and not list(diagnostics)
    assert [*nodes] == ["n0", "n1", "n2", "n3"]
    assert nodes["n0"].command == nodes["n3"].command == (str(tmp_path / "one"),)
    assert nodes["n1"].script is not None
    assert nodes["n2"].folder == tmp_path and nodes["n2"].cpp is None


def test_node_that_does_not_compile_is_missing_and_the_others_start(
    build: FakeBuild, find: Callable[..., Found]
) -> None:
    nodes, missing, diagnostics = find("bad", "does", "one")
    assert [*nodes] == ["n1", "n2"] and missing == 1
    assert [one.message for one in diagnostics] == ["'bad' of package 'tests_pkg' does not compile"]


def test_launch_without_cpp_asks_for_no_compiler(
    build: FakeBuild, find: Callable[..., Found]
) -> None:
    nodes, missing, _ = find("does")
    assert [*nodes] == ["n0"] and missing == 0
    assert build.batches == []


def test_libraries_of_nodelets_are_compiled_with_the_rest(
    build: FakeBuild, package: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(provided_programs, "ensure_program", lambda _program: tmp_path / "nodelet")
    config, diagnostics = LaunchConfig(), Diagnostics()
    for name, args in (("one", "load tests_pkg/Filter manager"), ("manager", "manager")):
        config.nodes.append(NodeTag("nodelet", "nodelet", name, args=args))
    config.nodes.append(NodeTag("tests_pkg", "one", "two"))
    workspace = Workspace.discover(environ={}, cwd=package)
    nodes, missing = find_executables(config, workspace, diagnostics, LaunchOptions())
    assert missing == 0 and not list(diagnostics)
    assert build.batches == [["one", ""]], "an empty name is all of a package"
    assert [executable.command for _, executable in nodes] == [
        (str(tmp_path / "nodelet"),), (str(tmp_path / "nodelet"),), (str(tmp_path / "one"),),
    ]  # fmt: skip


def test_one_node_is_compiled_for_rosrun(build: FakeBuild, package: Path, tmp_path: Path) -> None:
    workspace, diagnostics = Workspace.discover(environ={}, cwd=package), Diagnostics()
    found = find_and_compile("tests_pkg", "one", workspace=workspace, diagnostics=diagnostics)
    assert found is not None and found.command == (str(tmp_path / "one"),)
    found = find_and_compile("tests_pkg", "bad", workspace=workspace, diagnostics=diagnostics)
    assert found is None and len(diagnostics) == 1
