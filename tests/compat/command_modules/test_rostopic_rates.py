"""ROSTopicHz, ROSTopicDelay and ROSTopicBandwidth, as programs use them."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from gazelle.compat.command_modules import rostopic
from gazelle.compat.command_modules.rostopic import ROSTopicBandwidth, ROSTopicDelay, ROSTopicHz


def test_rate_is_that_of_the_times_between_messages(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    clock = [0.0]
    monkeypatch.setattr(rostopic, "get_time", lambda: clock[0])
    rates = ROSTopicHz(-1, filter_expr=lambda message: message != "skipped")
    for clock[0] in (1.0, 1.5, 2.0, 3.0):
        rates.callback_hz("counted", topic="/scan")
        rates.callback_hz("skipped", topic="/scan")
    assert rates.get_times("/scan") == [0.5, 0.5, 1.0]
    found = rates.get_hz("/scan")
    assert found is not None
    assert found[:3] == pytest.approx((1.5, 0.5, 1.0))
    assert found[4] == 4
    assert rates.get_hz("/scan") is None
    assert (rates.get_msg_t0("/scan"), rates.get_msg_tn("/scan")) == (1.0, 3.0)
    assert rates.get_msg_t0("/other") == -1
    clock[0] = 0.5
    rates.callback_hz("counted", topic="/scan")
    assert rates.get_times("/scan") == []
    rates.print_hz(["/scan"])
    assert capsys.readouterr().out == "no new messages\n"


def test_delay_is_taken_from_the_header(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(rostopic, "get_time", lambda: 10.0)
    delays = ROSTopicDelay(-1)
    for stamp in (9.0, 9.5):
        header = SimpleNamespace(stamp=SimpleNamespace(to_sec=lambda stamp=stamp: stamp))
        delays.callback_delay(SimpleNamespace(_has_header=True, header=header))
    delays.callback_delay(SimpleNamespace(_has_header=False))
    assert capsys.readouterr().out == "msg does not have header\n"
    assert delays.get_delay() == (0.75, 0.5, 1.0, 0.25, 2)
    assert delays.get_delay() is None


def test_bandwidth_tells_bytes_a_second_and_sizes(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    times = iter((1.0, 2.0, 3.0))
    monkeypatch.setattr("time.time", lambda: next(times))
    bandwidth = ROSTopicBandwidth()
    bandwidth.callback(SimpleNamespace(_buff=b"x" * 1000))
    bandwidth.callback(SimpleNamespace(_buff=b"x" * 3000))
    bandwidth.print_bw()
    out = capsys.readouterr().out
    assert out == "average: 2.00KB/s\n\tmean: 2.00KB min: 1.00KB max: 3.00KB window: 2\n"
