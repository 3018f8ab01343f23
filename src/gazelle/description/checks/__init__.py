"""Checks of descriptions that need no physics: records in, findings out."""

from __future__ import annotations

from gazelle.description.checks.all_checks import check_description
from gazelle.description.checks.inertia import SUPERSEDED_CODES

__all__ = ["SUPERSEDED_CODES", "check_description"]
