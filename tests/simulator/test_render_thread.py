"""Frames are rendered beside the loop, and what they need is loaded when somebody looks."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest
from tests.patience import stretched

from gazelle.simulator.render_thread import FrameWorker


class _Loading:
    """What takes long before the first frame."""

    def __init__(self) -> None:
        self.count = 0
        self.goes_on = threading.Event()

    def __call__(self) -> None:
        self.count += 1
        assert self.goes_on.wait(stretched())


@pytest.fixture
def loading() -> _Loading:
    return _Loading()


@pytest.fixture
def frames(loading: _Loading) -> Iterator[FrameWorker]:
    made = FrameWorker(loading)
    yield made
    loading.goes_on.set()
    made.close()


def test_nothing_is_loaded_before_a_frame_is_wanted(frames: FrameWorker, loading: _Loading) -> None:
    frames.wait()
    assert loading.count == 0


def test_frames_due_while_kernels_load_are_left_out_and_not_counted(
    frames: FrameWorker, loading: _Loading
) -> None:
    done: list[int] = []
    for number in range(3):
        assert frames.submit("camera", lambda number=number: done.append(number))
    loading.goes_on.set()
    frames.wait()
    assert (done, frames.dropped, loading.count) == ([0], {}, 1)


def test_a_frame_due_while_the_last_one_is_rendered_is_counted(
    frames: FrameWorker, loading: _Loading
) -> None:
    loading.goes_on.set()
    rendering, goes_on = threading.Event(), threading.Event()

    def render() -> None:
        rendering.set()
        assert goes_on.wait(stretched())

    frames.submit("camera", render)
    assert rendering.wait(stretched())
    assert not frames.submit("camera", render)
    assert frames.submit("other", lambda: None)
    goes_on.set()
    frames.wait()
    assert frames.dropped == {"camera": 1}


def test_a_frame_of_lock_step_is_done_at_once_behind_the_loading(
    frames: FrameWorker, loading: _Loading
) -> None:
    loading.goes_on.set()
    done: list[int] = []
    frames.do(lambda: done.append(loading.count))
    frames.do(lambda: done.append(loading.count))
    assert done == [1, 1]
