"""Errors of users' callbacks."""

from __future__ import annotations

from gazelle.graph.callback_errors import CallbackErrors


def _caught(key: str) -> Exception:
    try:
        {"a": 1}[key]
    except KeyError as error:
        return error
    raise AssertionError


def test_an_error_is_whole_once_and_then_counted() -> None:
    now = [0.0]
    errors = CallbackErrors(clock=lambda: now[0])
    first = errors.text("bad callback: f", _caught("b"))
    assert first.startswith("bad callback: f\nTraceback (most recent call last):\n")
    assert first.endswith("KeyError: 'b'\n")
    said = []
    for _ in range(30):
        now[0] += 1.0
        said.append(errors.text("bad callback: f", _caught("c")))
    told = [text for text in said if text]
    assert len(told) == 3
    assert told[0].startswith("bad callback: f\nthe same 10 more times: ")
    assert told[0].endswith("KeyError: 'c'\n")
    assert "test_callback_errors.py:10: " in told[0]


def test_errors_of_other_places_and_kinds_are_whole() -> None:
    errors = CallbackErrors(clock=lambda: 0.0)
    errors.text("h", _caught("b"))
    try:
        raise ValueError("other")
    except ValueError as error:
        assert "Traceback" in errors.text("h", error)
