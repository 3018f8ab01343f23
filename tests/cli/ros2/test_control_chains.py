"""``ros2 control view_controller_chains``: the diagram and where it goes."""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from gazelle.cli.ros2.control import view_controller_chains as chains


def _controller(name: str, **given: list[str]) -> Any:
    fields = ("required_state_interfaces", "required_command_interfaces", "reference_interfaces",
              "exported_state_interfaces")  # fmt: skip
    return SimpleNamespace(name=name, **{key: given.get(key, []) for key in fields})


def _hardware() -> Any:
    def named(*names: str) -> list[Any]:
        return [SimpleNamespace(name=name) for name in names]

    return SimpleNamespace(
        command_interfaces=named("j/effort"), state_interfaces=named("j/position")
    )


_PID = _controller("pid", required_state_interfaces=["j/position"], required_command_interfaces=[
    "j/effort"], reference_interfaces=["j/velocity"])  # fmt: skip
_DRIVE = _controller("drive", required_command_interfaces=["pid/j/velocity"])


class _Client:
    def controllers(self) -> list[Any]:
        return [_PID, _DRIVE]

    def call(self, name: str, kind: str) -> Any:
        return SimpleNamespace(component=[_hardware()])


def test_controllers_are_joined_to_hardware_and_to_each_other() -> None:
    text = chains.diagram([_PID, _DRIVE], [_hardware()])
    assert '"drive":"command_start_pid/j/velocity" -> "pid":"controller_end_pid/j/velocity"' in text
    assert '"pid":"command_start_j/effort" -> "command_interfaces":"command_end_j/effort"' in text
    assert '"state_interfaces":"state_start_j/position" -> "pid":"state_end_j/position"' in text
    assert text.index('"drive" [label') < text.index('"pid" [label')


def test_without_graphviz_its_source_is_saved(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(shutil, "which", lambda name: None)
    client: Any = _Client()
    assert chains.view_controller_chains(client, argparse.Namespace(save=True)) == 0
    assert (tmp_path / "controller_diagram.gv").read_text().startswith("digraph g {")
    assert "graphviz is not installed" in capsys.readouterr().out


@pytest.mark.skipif(shutil.which("dot") is None, reason="draws with graphviz")
def test_with_graphviz_a_pdf_is_saved(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    client: Any = _Client()
    assert chains.view_controller_chains(client, argparse.Namespace(save=True)) == 0
    assert [one.name for one in tmp_path.iterdir()] == ["controller_diagram.pdf"]
    assert (tmp_path / "controller_diagram.pdf").read_bytes().startswith(b"%PDF")
