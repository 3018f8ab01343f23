"""Compiling before the first scan counts."""

from __future__ import annotations

from gazelle.mapping.slam.kernel_warm_up import warm_up
from gazelle.numba_jit import kernels


def test_the_kernels_of_slam_are_ready_for_one_kind_of_scans() -> None:
    warm_up()
    own = [one for one in kernels() if one.py_func.__module__.startswith("gazelle.mapping.")]
    # Bounds are sums of bytes, what decides is one of numbers with a fraction.
    twice = {one.py_func.__name__ for one in own if len(one.signatures) > 1}
    assert own
    assert twice <= {"_sum"}
