"""A kernel is compiled when it is first called with arguments of a kind, once."""

from __future__ import annotations

import sys
import threading
from typing import Any

import numpy as np
import pytest
from tests.kernels.python_oracle import exact

from gazelle import announcements
from gazelle.kernels import Kernel, areas, compiling, kernel, kernels
from gazelle.kernels.source import KernelSource


def _double(x):
    return x + x


def _wrong(x):
    return x.nothing_of_this_name


@kernel
def _callee(x):
    return x * 2.5


@kernel
def _caller(x):
    return _callee(x) + _callee(2)


def _watched(run: Kernel, *calls: tuple[Any, ...]) -> list[str]:
    """Return what is compiled while a kernel is called."""
    seen: list[str] = []
    with compiling(lambda source, seconds: seen.append(f"{source.name} {seconds >= 0}")):
        for call in calls:
            run(*call)
    return seen


def test_each_kind_of_arguments_is_compiled_once() -> None:
    run = kernel(_double)
    said = "tests.kernels.test_dispatch._double True"
    assert _watched(run, (1,), (2,), (np.int8(1),), (-(2**40),)) == [said]
    assert _watched(run, (1.0,), (np.float64(2),), (1,), (True,)) == [said] * 2
    assert _watched(run, (1,), (2.0,), (False,)) == []
    assert len(run.signatures) == 3


def test_nothing_is_compiled_before_the_first_call() -> None:
    run = kernel(_double)
    assert run.signatures == []
    assert run in kernels()


def test_what_a_kernel_calls_is_compiled_with_it() -> None:
    assert _watched(_caller, (1,)) == ["tests.kernels.test_dispatch._caller True"]
    assert _callee.signatures == []
    assert _caller(1) == 7.5


def test_a_watcher_hears_nothing_afterwards() -> None:
    seen: list[KernelSource] = []
    with compiling(lambda source, _: seen.append(source)):
        pass
    kernel(_double)(1)
    assert seen == []


def test_what_cannot_be_compiled_is_told_each_time_and_the_rest_works() -> None:
    run = kernel(_wrong)
    texts = set()
    for _ in range(2):
        with pytest.raises(TypeError, match="there is no 'nothing_of_this_name' of this") as error:
            run(1.0)
        texts.add(str(error.value))
    assert len(texts) == 1
    assert run.signatures == []
    assert kernel(_double)(1) == 2


def test_after_a_kind_that_is_not_taken_calls_go_on() -> None:
    run = kernel(_double)
    assert run(1) == 2
    for wrong in ([1], "1", None, (1, 2), np.zeros(2)):
        with pytest.raises(TypeError):
            run(wrong)
        assert run(1) == 2
        assert sys.exc_info() == (None, None, None)
    assert exact(run(1.5)) == exact(3.0)


def test_threads_that_call_at_once_compile_once() -> None:
    run, count = kernel(_double), 8
    barrier, found = threading.Barrier(count), list[Any]()

    def call(number: int) -> None:
        barrier.wait()
        found.append(run(number if number % 2 else float(number)))

    seen: list[str] = []
    with compiling(lambda source, _: seen.append(source.name)):
        threads = [threading.Thread(target=call, args=(number,)) for number in range(count)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert len(seen) == len(run.signatures) == 2
    assert sorted(found) == [2 * number for number in range(count)]


def test_a_kernel_is_compiled_in_a_thread_while_another_calls_it() -> None:
    run, stop, found = kernel(_double), threading.Event(), list[Any]()
    run(1)

    def call() -> None:
        while not stop.is_set():
            found.append(run(1))

    thread = threading.Thread(target=call)
    thread.start()
    for value in (1.5, True, np.float32(1), np.uint8(1), np.uint64(1)):
        run(value)
    stop.set()
    thread.join()
    assert set(found) == {2}


def test_flags_are_kept_with_the_function() -> None:
    run = kernel(flags="nsz reassoc")(_double)
    assert run.source == KernelSource(_double, "nsz reassoc")
    assert run(1.5) == 3.0


def test_flags_that_llvm_does_not_know_are_told() -> None:
    with pytest.raises(RuntimeError, match="LLVM IR parsing error"):
        kernel(flags="quick")(_double)(1.5)


def test_compiling_is_announced_once_for_the_kernels_of_an_area(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(announcements, "_told", set())
    monkeypatch.setattr(areas, "AREAS", (areas.Area("tested", "tests", 7),))
    monkeypatch.setattr(_double, "__module__", "gazelle.tested.kernels", raising=False)
    run, said = kernel(_double), list[str]()
    with announcements.announced_by(said.append):
        run(1)
        run(1.5)
        kernel(_callee.source.function)(1)
    assert said == [
        "compiling the kernels of tests for this machine: up to 7 s of computing, once "
        "('gazelle warm' does it ahead)"
    ]


def test_a_kernel_knows_the_area_of_its_package() -> None:
    found = {area.package for area in areas.AREAS}
    assert {areas.area_of(f"gazelle.{package}.x_kernels") for package in found} == set(areas.AREAS)
    assert areas.area_of("gazelle.priority_queue_kernels") is None
    assert areas.area_of("kernel") is None
