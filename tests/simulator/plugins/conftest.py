"""Lets the laws of the families say what they compared."""

from __future__ import annotations

import pytest

pytest.register_assert_rewrite(
    *(f"tests.simulator.plugins.family_{name}" for name in ("drives", "sensors", "trial"))
)
