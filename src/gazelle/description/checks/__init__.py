"""Checks of descriptions that need no physics: records in, findings out."""

from __future__ import annotations
