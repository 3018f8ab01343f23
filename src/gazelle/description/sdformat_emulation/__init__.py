"""What the sdformat library does with robot descriptions, release by release."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.release import Release

__all__ = ["Release", "SdfElement"]
