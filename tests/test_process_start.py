"""What a process saves while it starts."""

from __future__ import annotations

import gc
import os
import subprocess
import sys
import weakref
from collections.abc import Iterator

import pytest

from gazelle.process_lifetime import collect_garbage_rarely, want_one_blas_thread

_THREADS_WITH_NUMPY = """
import sys
from gazelle.process_lifetime import want_one_blas_thread
want_one_blas_thread()
import os, numpy
print(os.environ["OPENBLAS_NUM_THREADS"], len(os.listdir("/proc/self/task")))
"""


class _Ring:
    itself: object = None


def _ring() -> weakref.ref[_Ring]:
    ring = _Ring()
    ring.itself = ring
    return weakref.ref(ring)


@pytest.fixture
def usual_thresholds() -> Iterator[None]:
    kept = gc.get_threshold()
    gc.set_threshold(700, 10, 10)
    yield
    gc.set_threshold(*kept)


@pytest.mark.usefixtures("usual_thresholds")
def test_cycles_are_still_found() -> None:
    collect_garbage_rarely()
    assert gc.isenabled() and gc.get_threshold()[0] == 10_000
    first = _ring()
    for _ in range(20_000):
        _ring()
    assert first() is None


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="counts threads in /proc")
def test_numpy_starts_no_threads() -> None:
    environ = {key: value for key, value in os.environ.items() if key != "OPENBLAS_NUM_THREADS"}
    words = [sys.executable, "-c", _THREADS_WITH_NUMPY]
    ended = subprocess.run(words, env=environ, capture_output=True, text=True, check=True)
    assert ended.stdout.split() == ["1", "1"]


def test_who_sets_the_number_of_threads_is_obeyed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "3")
    want_one_blas_thread()
    assert os.environ["OPENBLAS_NUM_THREADS"] == "3"
