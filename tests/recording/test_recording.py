"""Recordings as values: moments between moments, and parts."""

from __future__ import annotations

import numpy as np
import pytest
from tests.recorded import messages, rolling

from gazelle.recording import Recording, Stretch


def test_moments_between_two_are_in_proportion() -> None:
    stretch = rolling(1.0).stretches[0]
    row = list(stretch.link_names).index("cart::body")
    assert stretch.moment(500_000_000).T[row, 0] == pytest.approx(0.5)
    assert stretch.moment(505_000_000).T[row, 0] == pytest.approx(0.505)
    assert stretch.moment(-1).T[row, 0] == 0.0
    assert stretch.moment(9_000_000_000).T[row, 0] == pytest.approx(1.0)


def test_turns_between_two_go_the_shorter_way() -> None:
    whole = rolling(1.0).stretches[0]
    poses = whole.poses[:2].copy()
    poses[1, 2, 3:] *= -1.0
    stretch = Stretch(whole.world, whole.link_names, whole.times_ns[:2], poses)
    between = stretch.moment(10_000_000).T[2, 3:]
    assert between == pytest.approx([0.0, 0.0, np.sin(0.005), np.cos(0.005)], abs=1e-6)


def test_a_part_has_its_time_and_the_last_message_before() -> None:
    topic = messages("/word", "std_msgs/String", 2.0, 1.0, lambda t: {"data": f"at {t:g}"})
    whole = rolling(2.0, topics=(topic,))
    part = whole.part(1.5, 0.4)
    assert (part.start_s, part.duration_s) == pytest.approx((1.5, 0.4))
    assert [one.data for one in part.topics[0].messages] == ["at 1"]
    assert part.topics[0].times_ns.tolist() == [1_500_000_000]
    assert whole.part(0.5).duration_s == pytest.approx(1.5)
    with pytest.raises(ValueError, match="holds 2 s of simulated time, so there is nothing 3 s"):
        whole.part(3.0)


def test_a_part_between_two_moments_is_one_moment() -> None:
    part = rolling(1.0).part(0.505, 0.0)
    assert (part.duration_s, len(part.stretches)) == (0.0, 1)
    assert part.stretches[0].poses[0, 1, 0] == pytest.approx(0.505)


def test_a_stretch_lasts_until_the_next_begins() -> None:
    first = rolling(1.0).stretches[0]
    second = Stretch(first.world, first.link_names, first.times_ns + 2_000_000_000, first.poses)
    recording = Recording((first, second))
    assert recording.stretch_at(-5) is first
    assert recording.stretch_at(1_999_999_999) is first
    assert recording.stretch_at(2_000_000_000) is second
    assert (recording.start_s, recording.duration_s) == (0.0, 3.0)
