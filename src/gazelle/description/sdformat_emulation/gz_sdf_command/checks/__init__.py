"""Checks of normalised documents: names, joints, frames, as sdformat's objects make them."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.gz_sdf_command.checks.verdict import (
    check,
    load,
    name_problems,
)

__all__ = ["check", "load", "name_problems"]
