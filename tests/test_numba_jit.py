"""Kernels that several processes want at once are compiled by one of them."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.patience import eventually, stretched

from gazelle import announcements, numba_jit

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


_TOLD = """
from gazelle import numba_jit
from gazelle.announcements import announce_by
from numba.core import event

class Compiled(event.Listener):
    def on_start(self, event):
        print("compiled")

    def on_end(self, event):
        pass

announce_by(print)
numba_jit.AREAS = (numba_jit.Area("tested", "tests", 7),)
import sys, types
package = types.ModuleType("gazelle.tested")
package.__path__ = ["."]
sys.modules["gazelle.tested"] = package
from gazelle.tested.kernel import twice
with event.install_listener("numba:compile", Compiled()):
    assert twice(2) == 4
    assert twice(2.0) == 4.0
"""


def test_what_is_compiled_is_said_once_before_it_is_and_nothing_when_it_is_kept(
    start: Start,
) -> None:
    said = start(_TOLD).communicate(timeout=stretched())[0].splitlines()
    assert said == [
        "compiling the kernels of tests for this machine: up to 7 s of computing, once "
        "('gazelle warm' does it ahead)",
        "compiled",
        "compiled",
    ]
    assert start(_TOLD).communicate(timeout=stretched())[0] == ""


def test_who_waits_for_another_process_says_so_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    said: list[str] = []
    monkeypatch.setattr(announcements, "_told", set())
    monkeypatch.setattr(numba_jit, "_PATIENCE_S", -1.0)
    locks = iter([False, False, True])
    monkeypatch.setattr(numba_jit, "_lock", lambda _descriptor: next(locks))
    with announcements.announced_by(said.append):
        assert numba_jit._locked(0, tmp_path / "gazelle.motion.planning.sweep.lock")
    assert said == [
        "waiting for another process, which is compiling the kernels of arm planning for this "
        "machine, once"
    ]


_LITERALS = """
from gazelle.numba_jit import njit


@njit(cache=True)
def _times(a, b):
    return a * b


@njit(cache=True)
def area(x):
    return _times(2, x) + _times(3, x)


print(area(10), len(_times.signatures))
"""


def test_a_kernel_is_not_compiled_for_each_number_that_it_is_given(
    start: Start, tmp_path: Path
) -> None:
    (tmp_path / "literals.py").write_text(_LITERALS, encoding="utf-8")
    assert start("import literals").communicate(timeout=stretched())[0].split() == ["50", "1"]


_BY_ADDRESS = """
import numpy as np
from gazelle.numba_jit import njit


@njit(cache=True, is_called_by_address=True)
def scaled(values, factor):
    total = 0.0
    for k in range(len(values)):
        values[k] *= {factor} * factor
        total += values[k]
    return total, len(values)


@njit(cache=True)
def _between(values):
    return scaled(values, 2.0)


@njit(cache=True)
def whole(values):
    return _between(values)[0] + scaled(values, 1.0)[1]


values = np.arange(3.0)
print(whole(values), values[2], len(scaled.signatures), sum(whole.stats.cache_hits.values()))
"""


def test_a_kernel_that_is_called_by_address_does_the_same_compiled_kept_and_changed(
    start: Start, tmp_path: Path
) -> None:
    seen = []
    for factor in ("1.0", "1.0", "10.0", "10.0"):
        text = _BY_ADDRESS.format(factor=factor)
        if not seen or text != (tmp_path / "linked.py").read_text(encoding="utf-8"):
            (tmp_path / "linked.py").write_text(text, encoding="utf-8")
        seen.append(start("import linked").communicate(timeout=stretched())[0].strip())
    assert seen == ["9.0 4.0 1 0", "9.0 4.0 1 1", "63.0 400.0 1 0", "63.0 400.0 1 1"]


def test_a_caller_is_compiled_anew_where_what_it_calls_by_address_is_not_there(
    start: Start, tmp_path: Path
) -> None:
    (tmp_path / "linked.py").write_text(_BY_ADDRESS.format(factor="1.0"), encoding="utf-8")
    assert start("import linked").wait(stretched()) == 0
    for file in (tmp_path / "cache").rglob("linked.scaled*"):
        file.unlink()
    assert start("import linked").communicate(timeout=stretched())[0].strip() == "9.0 4.0 1 1"


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


def test_compiling_leaves_the_streams_of_other_threads_alone() -> None:
    pytest.importorskip("colorama", reason="numba touches the streams only where it is installed")
    program = (
        "import sys, types, numba\n"
        "from gazelle.numba_jit import njit\n"
        "class Watched(types.ModuleType):\n"
        "    def __setattr__(self, name, value):\n"
        "        if name in ('stdout', 'stderr'): print('set', name)\n"
        "        super().__setattr__(name, value)\n"
        "sys.__class__ = Watched\n"
        "@njit()\n"
        "def wrong(x):\n"
        "    return x.nothing_of_this_name\n"
        "try:\n"
        "    wrong(1.0)\n"
        "except numba.TypingError as error:\n"
        "    print('nothing_of_this_name' in str(error))\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", program], check=False, capture_output=True, text=True
    )
    assert (run.stdout, run.stderr) == ("True\n", "")
