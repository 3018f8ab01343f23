"""Compiling before the first scan counts."""

from __future__ import annotations

from gazelle.kernels import kernels
from gazelle.mapping.slam.kernel_warm_up import warm_up


def test_the_kernels_of_slam_are_ready_for_one_kind_of_scans() -> None:
    warm_up()
    own = [one for one in kernels() if one.source.name.startswith("gazelle.mapping.")]
    assert own
    assert not [one for one in own if len(one.signatures) > 1]
