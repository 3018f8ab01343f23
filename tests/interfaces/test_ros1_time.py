from __future__ import annotations

import pickle

import numpy as np
import pytest

from gazelle.interfaces import Duration, Time


def test_parts_are_brought_into_range():
    time = Time(1, 2_500_000_000)
    assert (time.secs, time.nsecs) == (3, 500_000_000)
    span = Duration(0, -1)
    assert (span.secs, span.nsecs) == (-1, 999_999_999)
    span.set(1, 3_000_000_000)
    span.canon()
    assert (span.secs, span.nsecs) == (4, 0)


def test_floats_are_split():
    assert (Time(1.5).secs, Time(1.5).nsecs) == (1, 500_000_000)
    assert Duration.from_sec(-0.25).to_sec() == -0.25
    assert Time(np.int64(3)).secs == 3
    with pytest.raises(ValueError, match="nsecs cannot be set"):
        Time(1.5, 2)


def test_times_are_positive():
    with pytest.raises(TypeError, match="time values must be positive"):
        Time(-1)


def test_arithmetic_gives_the_right_kinds():
    assert Time(5) - Time(3, 500_000_000) == Duration(1, 500_000_000)
    assert Time(5) - Duration(1) == Time(4)
    assert Time(5) + Duration(0, 1) == Duration(0, 1) + Time(5) == Time(5, 1)
    assert Duration(3) * 0.5 == 0.5 * Duration(3) == Duration(1, 500_000_000)
    assert Duration(3) / 2 == Duration(1.5)
    assert Duration(3) / Duration(2) == 1.5
    assert Duration(3) // Duration(2) == 1
    assert Duration(3) % Duration(2) == Duration(1)
    assert divmod(Duration(3), Duration(2)) == (1, Duration(1))
    assert abs(Duration(-2)) == -Duration(-2) == Duration(2)
    for wrong in (lambda: Time(1) + Time(1), lambda: Time(1) + 1, lambda: Duration(1) - 1):
        with pytest.raises(TypeError):
            wrong()


def test_subclasses_stay_themselves():
    class Stamp(Time):
        pass

    assert type(Stamp(1) + Duration(1)) is Stamp
    assert type(Stamp.from_sec(1.0)) is Stamp


def test_comparison_is_within_a_kind():
    assert Time(1) < Time(1, 1) <= Time(2)
    assert Duration(-1) < Duration(0) and Duration(1) > Duration(0) >= Duration(0)
    assert Time(1) != Duration(1)
    with pytest.raises(TypeError):
        _ = Time(1) < Duration(1)
    assert len({Time(1), Time(1), Time(2)}) == 2


def test_texts_and_numbers():
    assert str(Time(1, 5)) == "1000000005"
    assert repr(Duration(1)) == "genpy.Duration[1000000000]"
    assert Time(2, 1).to_nsec() == 2_000_000_001
    assert Time(2, 500_000_000).to_time() == 2.5
    assert Time().is_zero() and not Time() and Time(1)
    assert pickle.loads(pickle.dumps(Time(1, 2))) == Time(1, 2)
