"""Kernels that several processes want at once are compiled by one of them."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.patience import eventually, stretched

from gazelle import announcements
from gazelle.kernels import kept_code, kernel, turns

_KERNEL = """
from gazelle.kernels import kernel


@kernel
def twice(x):
    return 2 * x
"""
_FIRST = """
import time
from pathlib import Path
from gazelle.kernels import dispatch
from kernel import twice

compiled = dispatch._compiled

def held(*arguments):
    Path("compiling").touch()
    while not Path("go on").exists():
        time.sleep(0.01)
    return compiled(*arguments)

dispatch._compiled = held
assert twice(2) == 4
"""
_SECOND = """
from pathlib import Path
from gazelle.announcements import announce_by
from gazelle.kernels import compiling, turns
from kernel import twice

class Clock:
    monotonic = turns.time.monotonic
    sleep_s = staticmethod(turns.time.sleep)

    @classmethod
    def sleep(cls, duration_s):
        Path("waiting").touch()
        cls.sleep_s(duration_s)

turns.time = Clock
turns._PATIENCE_S = -1.0
announce_by(print)
with compiling(lambda source, _: print("compiled", source.name)):
    assert twice(2) == 4
"""
_WAITING = "waiting for another process, which is compiling the kernels for this machine, once"

Start = Callable[[str], "subprocess.Popen[str]"]


@pytest.fixture
def start(tmp_path: Path) -> Start:
    (tmp_path / "kernel.py").write_text(_KERNEL, encoding="utf-8")

    def run(code: str) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, "-c", code], cwd=tmp_path, stdout=subprocess.PIPE, text=True,
            env={**os.environ, kept_code.VARIABLE: str(tmp_path / "cache")},
        )  # fmt: skip

    return run


def test_who_comes_second_waits_says_so_and_loads(start: Start, tmp_path: Path) -> None:
    first = start(_FIRST)
    eventually((tmp_path / "compiling").exists)
    second = start(_SECOND)
    eventually((tmp_path / "waiting").exists)
    (tmp_path / "go on").touch()
    assert second.communicate(timeout=stretched())[0].splitlines() == [_WAITING]
    assert first.wait(stretched()) == 0


def test_a_process_that_was_killed_keeps_nobody_waiting(start: Start, tmp_path: Path) -> None:
    first = start(_FIRST)
    eventually((tmp_path / "compiling").exists)
    first.kill()
    first.communicate(timeout=stretched())
    second = start(_SECOND)
    assert second.communicate(timeout=stretched())[0].splitlines() == ["compiled kernel.twice"]
    assert second.returncode == 0


@kernel
def _own(x):
    return x


def test_where_nothing_can_be_written_nobody_waits(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with turns.turn(tmp_path / "file" / "folder" / "kernel.lock", _own.source):
        pass


def test_who_has_the_turn_does_not_wait_for_itself(tmp_path: Path) -> None:
    path = tmp_path / "folder" / "a.lock"
    with turns.turn(path, _own.source), turns.turn(path, _own.source):
        assert path.exists()
    assert not turns._held


def test_the_turn_is_over_where_compiling_fails(tmp_path: Path) -> None:
    path = tmp_path / "a.lock"
    with pytest.raises(TypeError), turns.turn(path, _own.source):
        raise TypeError
    assert not turns._held
    descriptor = os.open(path, os.O_RDWR)
    try:
        assert turns._lock(descriptor)
    finally:
        os.close(descriptor)


def test_nobody_waits_for_ever(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(turns, "_MAX_WAIT_S", 0.05)
    descriptor = os.open(tmp_path / "a.lock", os.O_RDWR | os.O_CREAT)
    try:
        assert turns._locked(descriptor, _own.source)
        with turns.turn(tmp_path / "a.lock", _own.source):
            pass
    finally:
        os.close(descriptor)


@pytest.mark.parametrize(
    ("module", "what"), [("gazelle.motion.planning.x_kernels", " of arm planning"), ("kernel", "")]
)
def test_who_waits_for_another_process_says_so_once(
    monkeypatch: pytest.MonkeyPatch, module: str, what: str
) -> None:
    def function(x: float) -> float:
        return x

    function.__module__ = module
    said: list[str] = []
    monkeypatch.setattr(announcements, "_told", set())
    monkeypatch.setattr(turns, "_PATIENCE_S", -1.0)
    locks = iter([False, False, True])
    monkeypatch.setattr(turns, "_lock", lambda _descriptor: next(locks))
    with announcements.announced_by(said.append):
        assert turns._locked(0, kernel(function).source)
    assert said == [
        f"waiting for another process, which is compiling the kernels{what} for this machine, once"
    ]


def test_the_seconds_of_patience_are_not_told(monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    monkeypatch.setattr(announcements, "_told", set())
    monkeypatch.setattr(turns, "_PATIENCE_S", 1e9)
    locks = iter([False, True])
    monkeypatch.setattr(turns, "_lock", lambda _descriptor: next(locks))
    with announcements.announced_by(said.append):
        assert turns._locked(0, _own.source)
    assert said == []
