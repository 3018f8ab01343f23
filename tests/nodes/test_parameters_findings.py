"""What nodes say of their parameters."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Level
from gazelle.nodes.parameters import log_findings


def _idle(count: int) -> Diagnostics:
    found = Diagnostics()
    for number in range(count):
        found.report("parameter.idle", f"parameter 'p{number}' has no effect here")
    return found


def test_parameters_without_effect_are_one_line_and_listed_in_the_log_file(
    bench: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    assert log_findings(bench.node, _idle(12))
    (file,) = tmp_path.glob("test-*.log")
    told = capsys.readouterr().out
    assert told.count("\n") == 1
    assert (
        f"12 settings are known and have no effect here; all of them: {file}; the first: " in told
    )
    assert [f"'p{number}'" in file.read_text() for number in range(12)] == [True] * 12


def test_the_launchs_log_file_is_used(bench: Any, tmp_path: Path) -> None:
    bench.node.log_path = str(tmp_path / "node-3.log")
    log_findings(bench.node, _idle(2))
    assert "'p1'" in (tmp_path / "node-3.log").read_text()


def test_level_debug_and_folders_that_cannot_be_written_say_all(
    bench: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bench.node.log_path = str(tmp_path / "file" / "node.log")
    (tmp_path / "file").write_text("")
    log_findings(bench.node, _idle(3))
    assert capsys.readouterr().out.count("has no effect here") == 3
    bench.node.log_path, bench.node.log_level = str(tmp_path / "node.log"), Level.DEBUG
    log_findings(bench.node, _idle(4))
    assert capsys.readouterr().out.count("has no effect here") == 4


def test_errors_are_told_and_counted(bench: Any, capsys: pytest.CaptureFixture[str]) -> None:
    found = Diagnostics()
    found.report("mapping.lua", "unfinished string")
    assert not log_findings(bench.node, found)
    assert "unfinished string" in capsys.readouterr().err
