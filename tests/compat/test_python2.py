"""Python 2 sources keep their meaning."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.compat import warn_once
from gazelle.compat.python2 import compile_source, is_python2


@pytest.fixture(autouse=True)
def _as_a_new_process(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    # Each file is told of once a process, and all tests here say "node.py".
    monkeypatch.setattr(warn_once, "_TOLD", set())


def _run(source: str) -> dict[str, object]:
    space: dict[str, object] = {}
    exec(compile_source(source.encode(), "node.py"), space)
    return space


def test_print_statement_and_old_except_run(capsys: pytest.CaptureFixture[str]) -> None:
    _run("try:\n  raise ValueError, 'x'\nexcept ValueError, e:\n  print 'got', e\n")
    found = capsys.readouterr()
    assert found.out == "got x\n"
    assert "node.py: info: Python 2 source, translated on the fly" in found.err


def test_division_of_integers_stays_whole() -> None:
    space = _run("print 'x'\na = 7 / 2\nb = 7.0 / 2\nc = -7 / 2\nd = 9\nd /= 2\n")
    assert (space["a"], space["b"], space["c"], space["d"]) == (3, 3.5, -4, 4)


def test_future_division_is_respected() -> None:
    assert _run("from __future__ import division\nprint 'x'\na = 7 / 2\n")["a"] == 3.5


def test_python_3_source_is_left_alone(capsys: pytest.CaptureFixture[str]) -> None:
    assert _run("a = 7 / 2\n")["a"] == 3.5
    assert capsys.readouterr().err == ""


def test_old_builtins_without_a_shebang_of_3_mean_python_2() -> None:
    assert is_python2(b"for i in xrange(3): pass\n")
    assert not is_python2(b"#!/usr/bin/env python3\nfor i in xrange(3): pass\n")
    assert not is_python2(b"def reduce(a): return a\nreduce(1)\n")


def test_error_of_a_file_that_is_neither_is_python_3s() -> None:
    with pytest.raises(SyntaxError) as caught:
        compile_source(b"def f(:\n  pass\n", "bad.py")
    assert (caught.value.filename, caught.value.lineno) == ("bad.py", 1)


def test_lines_of_errors_stay_those_of_the_file() -> None:
    code = compile_source(b"print 'a'\n\n\n1 / 0\n", "node.py")
    with pytest.raises(ZeroDivisionError) as caught:
        exec(code, {})
    frames = [item.lineno for item in caught.traceback if str(item.path).endswith("node.py")]
    assert [line + 1 for line in frames] == [4]


@pytest.mark.tutorial
def test_teleop_of_the_slam_tutorial_compiles_unmodified(workspaces_dir: Path) -> None:
    script = workspaces_dir / "catkin_ws/src/slam_robot/scripts/slam_robot_teleop.py"
    source = script.read_bytes()
    assert is_python2(source)
    assert compile_source(source, str(script)).co_filename == str(script)
