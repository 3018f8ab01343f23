"""Kernels that several processes want at once are compiled by one of them."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.patience import eventually, stretched

from gazelle import numba_jit

KERNEL = """
from gazelle.numba_jit import njit


@njit(cache=True)
def twice(x):
    return 2 * x
"""
FIRST = """
import sys, time
from pathlib import Path
from numba.core import event
from kernel import twice

class Held(event.Listener):
    def on_start(self, event):
        Path("compiling").touch()
        while not Path("go on").exists():
            time.sleep(0.01)

    def on_end(self, event):
        pass

with event.install_listener("numba:compile", Held()):
    assert twice(2) == 4
"""
SECOND = """
from pathlib import Path
from gazelle import numba_jit
from kernel import twice

class Clock:
    monotonic = numba_jit.time.monotonic
    sleep_s = staticmethod(numba_jit.time.sleep)

    @classmethod
    def sleep(cls, duration_s):
        Path("waiting").touch()
        cls.sleep_s(duration_s)

numba_jit.time = Clock
assert twice(2) == 4
print(sum(twice.stats.cache_misses.values()))
"""

Start = Callable[[str], "subprocess.Popen[str]"]


@pytest.fixture
def start(tmp_path: Path) -> Start:
    (tmp_path / "kernel.py").write_text(KERNEL, encoding="utf-8")

    def run(code: str) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, "-c", code], cwd=tmp_path, stdout=subprocess.PIPE, text=True,
            env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")},
        )  # fmt: skip

    return run


def test_who_comes_second_waits_and_loads(start: Start, tmp_path: Path) -> None:
    first = start(FIRST)
    eventually((tmp_path / "compiling").exists)
    second = start(SECOND)
    eventually((tmp_path / "waiting").exists)
    (tmp_path / "go on").touch()
    assert second.communicate(timeout=stretched())[0].strip() == "0"
    assert first.wait(stretched()) == 0


def test_a_process_that_was_killed_keeps_nobody_waiting(start: Start, tmp_path: Path) -> None:
    first = start(FIRST)
    eventually((tmp_path / "compiling").exists)
    first.kill()
    first.wait(stretched())
    second = start(SECOND)
    assert second.communicate(timeout=stretched())[0].strip() == "1"


def test_where_nothing_can_be_written_nobody_waits(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with numba_jit._turn(tmp_path / "file" / "folder" / "kernel.lock"):
        pass


def test_a_kernel_that_compiles_itself_does_not_wait_for_itself(tmp_path: Path) -> None:
    with numba_jit._turn(tmp_path / "a.lock"), numba_jit._turn(tmp_path / "a.lock"):
        pass
    assert not numba_jit._held


def test_nobody_waits_for_ever(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numba_jit, "_MAX_WAIT_S", 0.05)
    descriptor = os.open(tmp_path / "a.lock", os.O_RDWR | os.O_CREAT)
    try:
        assert numba_jit._locked(descriptor, tmp_path / "a.lock")
        with numba_jit._turn(tmp_path / "a.lock"):
            pass
    finally:
        os.close(descriptor)


_CALLEE = """
from gazelle.numba_jit import njit


@njit(cache=True)
def factor():
    return {factor}
"""
_CALLER = """
from callee import factor
from gazelle.numba_jit import njit


@njit(cache=True)
def times(x):
    return factor() * x


print(times(10), sum(times.stats.cache_hits.values()))
"""


def test_a_kernel_is_compiled_anew_where_one_that_it_calls_has_changed(
    start: Start, tmp_path: Path
) -> None:
    """What is kept on disk holds the code of both."""
    (tmp_path / "caller.py").write_text(_CALLER, encoding="utf-8")
    seen = []
    for factor in ("2", "2", "3.0"):
        text = _CALLEE.format(factor=factor)
        if not (tmp_path / "callee.py").exists() or factor != "2":
            (tmp_path / "callee.py").write_text(text, encoding="utf-8")
        seen.append(start("import caller").communicate(timeout=stretched())[0].strip())
    assert seen == ["20 0", "20 1", "30.0 0"]


_RECORD = """
from typing import NamedTuple


class Inner(NamedTuple):
    {fields}


class Pair(NamedTuple):
    inner: Inner
"""
_READER = """
from gazelle.numba_jit import njit
from record import Inner, Pair


@njit(cache=True)
def first(pair):
    return pair.inner.a


print(first(Pair(Inner(a=1.0, b=2.0))), sum(first.stats.cache_hits.values()))
"""
_MAKER = """
from gazelle.numba_jit import njit
from record import Inner


@njit(cache=True)
def first(a, b):
    return Inner(a=a, b=b)[0]


print(first(1.0, 2.0), sum(first.stats.cache_hits.values()))
"""


@pytest.mark.parametrize(("kernel", "last"), [(_READER, "1.0 0"), (_MAKER, "2.0 0")])
def test_a_kernel_is_compiled_anew_where_fields_of_its_records_have_another_order(
    start: Start, tmp_path: Path, kernel: str, last: str
) -> None:
    (tmp_path / "reader.py").write_text(kernel, encoding="utf-8")
    seen = []
    for fields in ("a: float; b: float", "a: float; b: float", "b: float; a: float"):
        text = _RECORD.format(fields=fields)
        if not seen or text != (tmp_path / "record.py").read_text(encoding="utf-8"):
            (tmp_path / "record.py").write_text(text, encoding="utf-8")
        seen.append(start("import reader").communicate(timeout=stretched())[0].strip())
    assert seen == ["1.0 0", "1.0 1", last]


def test_a_kernel_is_compiled_anew_where_a_record_of_it_has_another_name(
    start: Start, tmp_path: Path
) -> None:
    seen = []
    for name in ("Pair", "Pair", "Two"):
        record = _RECORD.format(fields="a: float; b: float").replace("Pair", name)
        (tmp_path / "record.py").write_text(record, encoding="utf-8")
        if not seen or name == "Two":
            (tmp_path / "reader.py").write_text(_READER.replace("Pair", name), encoding="utf-8")
        seen.append(start("import reader").communicate(timeout=stretched())[0].strip())
    assert seen == ["1.0 0", "1.0 1", "1.0 0"]
