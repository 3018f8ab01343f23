"""Compiling before the first scan counts."""

from __future__ import annotations

import pytest

from gazelle.mapping.slam import kernel_warm_up


def test_a_first_time_that_takes_long_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[str] = []
    monkeypatch.setattr(kernel_warm_up, "_PATIENCE_S", 0.0)
    kernel_warm_up.warm_up(told.append)
    assert told == [
        "SLAM is compiled for this machine, which takes up to a minute once; scans count after that"
    ]


def test_nothing_is_said_when_all_is_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[str] = []
    monkeypatch.setattr(kernel_warm_up, "_PATIENCE_S", 600.0)
    kernel_warm_up.warm_up(told.append)
    assert told == []
