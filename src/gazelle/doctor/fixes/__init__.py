"""Fixes that can be written into the files: found in a finding's words, tried before offered."""

from __future__ import annotations

from gazelle.doctor.fixes.candidates import candidates
from gazelle.doctor.fixes.edits import Edit, SourceText, difference, edited
from gazelle.doctor.fixes.mend import Mended, mend
from gazelle.doctor.fixes.plan import FixPlan, plan_fixes, write_fixes
from gazelle.doctor.fixes.trial import Trial

__all__ = [
    "Edit",
    "FixPlan",
    "Mended",
    "SourceText",
    "Trial",
    "candidates",
    "difference",
    "edited",
    "mend",
    "plan_fixes",
    "write_fixes",
]
