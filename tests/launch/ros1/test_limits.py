"""Launch files that would take for ever."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.launch.ros1.loader import load_launch_files, load_launch_text
from gazelle.workspace import Workspace


def _found(body: str) -> list[str]:
    diagnostics = Diagnostics()
    start = time.thread_time()
    workspace = Workspace.discover(extra=[])
    try:
        load_launch_text(
            f"<launch>{body}</launch>", {}, workspace=workspace, diagnostics=diagnostics
        )
    except GazelleError:
        assert diagnostics.errors
    assert time.thread_time() - start < 10.0
    return [f"{item.message} [{item.code}]" for item in diagnostics]


def test_command_of_a_parameter_that_prints_without_end_is_ended(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("GAZELLE_LIMITS", "0.015625")
    assert _found('<param name="a" command="cat /dev/zero"/>') == [
        "Cannot load command parameter [a]: 'cat /dev/zero' prints more than 1 MiB and was ended "
        "(if the file means it, set the environment variable GAZELLE_LIMITS=10 for ten times) "
        "[launch.param-command-failed]"
    ]


@pytest.mark.parametrize("expression", ["9**9**9", "'a'*10**10", "[0]*10**10", "1 &lt;&lt; 10**9"])
def test_evaluated_expressions_have_limits(expression: str) -> None:
    (found,) = _found(f'<param name="a" value="$(eval {expression})"/>')
    assert found.startswith("$(eval ")
    assert "is above the limit of " in found
    assert found.endswith("[limits.expression]")


def test_angles_and_aliases_in_yaml_have_limits() -> None:
    lists = ["a0: &a0 [x,x,x,x,x,x,x,x,x,x]"]
    lists += [f"a{n + 1}: &a{n + 1} [{','.join([f'*a{n}'] * 10)}]" for n in range(9)]
    found = _found("<rosparam>" + "\n".join(lists).replace("&", "&amp;") + "</rosparam>")
    assert "12345679021 values, aliases followed are above the limit" in found[0]
    assert "[launch.bad-yaml]" in found[0]
    assert "binary digits is above the limit" in _found("<rosparam>a: deg(9**9**9)</rosparam>")[0]
    assert (
        "this value cannot be read: invalid syntax" in _found("<rosparam>a: rad(1 2)</rosparam>")[0]
    )


def test_files_that_include_each_other_under_new_names_are_a_cycle(tmp_path: Path) -> None:
    (tmp_path / "x").mkdir()
    path = tmp_path / "a.launch"
    path.write_text('<launch><include file="x/../a.launch"/></launch>')
    diagnostics = Diagnostics()
    workspace = Workspace.discover(extra=[])
    load_launch_files([path], {}, workspace=workspace, diagnostics=diagnostics)
    assert [item.code for item in diagnostics] == ["launch.include-cycle"]


def test_files_that_include_others_twice_are_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gazelle.launch.ros1.element_attributes._MAX_INCLUDES", 100)
    for number in range(40):
        include = f'<include file="{number + 1}.launch"/>'
        (tmp_path / f"{number}.launch").write_text(f"<launch>{include}{include}</launch>")
    diagnostics = Diagnostics()
    workspace = Workspace.discover(extra=[])
    load_launch_files([tmp_path / "0.launch"], {}, workspace=workspace, diagnostics=diagnostics)
    assert "more than 100 files are included" in [item.message for item in diagnostics]
