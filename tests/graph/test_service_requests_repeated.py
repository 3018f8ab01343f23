"""Requests that come twice."""

from __future__ import annotations

import threading

import pytest
from tests.patience import stretched

from gazelle.graph import service_requests
from gazelle.graph.service_requests import Answer, AnsweredRequests

_CLIENT, _OTHER = b"a" * 16, b"b" * 16


class _Handler:
    """Counts what it is given to do."""

    def __init__(self, answer: bytes = b"yes") -> None:
        self.count = 0
        self._answer = answer

    def __call__(self) -> Answer:
        self.count += 1
        return self._answer, ""


def test_request_that_comes_twice_is_handled_once() -> None:
    known, handler = AnsweredRequests(), _Handler()
    answers = [known.answer(_CLIENT, 1, handler) for _ in range(3)]
    assert (answers, handler.count) == ([(b"yes", "")] * 3, 1)
    known.answer(_CLIENT, 2, handler)
    known.answer(_OTHER, 1, handler)
    assert handler.count == 3


def test_request_of_a_client_that_does_not_count_is_always_handled() -> None:
    known, handler = AnsweredRequests(), _Handler()
    for _ in range(3):
        known.answer(bytes(16), 0, handler)
    assert handler.count == 3


def test_repeat_waits_for_what_is_under_way() -> None:
    known, second = AnsweredRequests(), _Handler()
    begun, go_on = threading.Event(), threading.Event()
    got: list[Answer] = []

    def slow() -> Answer:
        begun.set()
        assert go_on.wait(stretched(30))
        return b"late", ""

    threads = [threading.Thread(target=lambda: got.append(known.answer(_CLIENT, 7, slow)))]
    threads[0].start()
    assert begun.wait(stretched(30))
    threads.append(threading.Thread(target=lambda: got.append(known.answer(_CLIENT, 7, second))))
    threads[1].start()
    go_on.set()
    for thread in threads:
        thread.join(stretched(30))
    assert (got, second.count) == ([(b"late", "")] * 2, 0)


def test_old_answers_make_room(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(service_requests, "_KEPT_BYTES", 25)
    known, handler = AnsweredRequests(), _Handler(b"x" * 10)
    for number in (1, 2, 3):
        known.answer(_CLIENT, number, handler)
    known.answer(_CLIENT, 3, handler)
    assert handler.count == 3
    known.answer(_CLIENT, 1, handler)
    assert handler.count == 4
