"""Kernels are ready after warming up."""

from __future__ import annotations

from gazelle.motion.kinematics import kernels, warm_up


def test_all_kernels_are_compiled_for_what_is_asked() -> None:
    warm_up()
    for kernel in (kernels.chain_pose, kernels.chain_jacobian, kernels.solve, kernels.tree):
        assert len(kernel.signatures) == 1, "robots of every size use the same code"
