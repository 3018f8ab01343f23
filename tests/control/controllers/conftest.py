"""Lets the laws of the types say what they compared."""

from __future__ import annotations

import pytest

pytest.register_assert_rewrite(
    *(
        f"tests.control.controllers.{name}"
        for name in ("drive_laws", "trajectory_laws", "type_bench")
    )
)
