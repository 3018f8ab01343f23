from __future__ import annotations

import math
import re

import pytest

from gazelle.geometry import Pose
from gazelle.graph.tf.exceptions import ExtrapolationError
from gazelle.graph.tf.history import History, Sample, StaticHistory, interpolate

S = 1_000_000_000


def _at(stamp_s: float, x_m: float = 0.0, parent: str = "odom") -> Sample:
    return Sample(round(stamp_s * S), parent, Pose((x_m, 0.0, 0.0)))


def _history(*stamps_s: float) -> History:
    history = History(_at(stamps_s[0], stamps_s[0]))
    for stamp_s in stamps_s[1:]:
        assert history.add(_at(stamp_s, stamp_s), 10 * S) == ""
    return history


def test_positions_are_interpolated_linearly() -> None:
    history = _history(1.0, 2.0, 4.0)
    for stamp_s in (1.0, 1.25, 2.0, 3.5, 4.0):
        assert history.at(round(stamp_s * S)).pose.position_m[0] == pytest.approx(stamp_s)
    assert history.at(0).stamp_ns == 4 * S


def test_orientations_follow_the_great_arc_at_constant_rate() -> None:
    first = Pose.from_xyz_rpy((0, 0, 0), (0.0, 0.0, -0.4))
    second = Pose.from_xyz_rpy((0, 0, 0), (0.0, 0.0, 1.2))
    for ratio in (0.0, 0.25, 0.5, 1.0):
        assert interpolate(first, second, ratio).rpy_rad[2] == pytest.approx(-0.4 + 1.6 * ratio)


def test_orientations_take_the_shorter_way() -> None:
    x, y, z, w = Pose.from_xyz_rpy((0, 0, 0), (0.0, 0.0, 0.2)).quat_xyzw
    middle = interpolate(Pose(), Pose((0, 0, 0), (-x, -y, -z, -w)), 0.5)
    assert middle.rpy_rad[2] == pytest.approx(0.1)
    assert math.hypot(*middle.quat_xyzw) == pytest.approx(1.0)


def test_late_samples_find_their_place() -> None:
    history = _history(1.0, 3.0)
    assert history.add(_at(2.0, 5.0), 10 * S) == ""
    assert history.at(2 * S).pose.position_m[0] == 5.0
    assert len(history) == 3


def test_same_time_again_is_dropped() -> None:
    history = _history(1.0, 2.0)
    assert history.add(_at(2.0, 9.0), 10 * S) == "TF_REPEATED_DATA"
    assert history.at(2 * S).pose.position_m[0] == 2.0


def test_old_samples_are_dropped() -> None:
    history = _history(1.0, 5.0, 12.0)
    assert (len(history), history.oldest_ns) == (2, 5 * S)
    assert history.add(_at(1.5), 10 * S) == "TF_OLD_DATA"


@pytest.mark.parametrize(
    ("stamps_s", "asked_s", "text"),
    [
        (
            (1.0, 2.0),
            2.5,
            "Lookup would require extrapolation 0.500000000s into the future.  Requested time "
            "2.500000000 but the latest data is at time 2.000000000",
        ),
        (
            (1.0, 2.0),
            0.25,
            "Lookup would require extrapolation 0.750000000s into the past.  Requested time "
            "0.250000000 but the earliest data is at time 1.000000000",
        ),
        (
            (1.0,),
            2.0,
            "Lookup would require extrapolation at time 2.000000000, but only time 1.000000000 is "
            "in the buffer",
        ),
    ],
)
def test_extrapolation_is_refused_in_tf2_words(
    stamps_s: tuple[float, ...], asked_s: float, text: str
) -> None:
    with pytest.raises(ExtrapolationError, match=f"^{re.escape(text)}$"):
        _history(*stamps_s).at(round(asked_s * S))


def test_nothing_is_interpolated_across_a_change_of_parent() -> None:
    history = _history(1.0)
    history.add(_at(2.0, 7.0, parent="map"), 10 * S)
    assert history.at(round(1.5 * S)) == _at(1.0, 1.0)


def test_static_frames_hold_at_any_time() -> None:
    history = StaticHistory(_at(5.0, 1.0))
    assert history.at(123).pose.position_m[0] == 1.0
    assert history.add(_at(1.0, 2.0), S) == ""
    assert history.at(9 * S) == _at(9.0, 2.0)
    assert (history.latest.stamp_ns, history.oldest_ns, len(history)) == (0, 0, 1)
