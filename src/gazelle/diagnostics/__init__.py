"""Findings about users' files: places, severities, collecting and rendering them."""

from __future__ import annotations

from gazelle.diagnostics.collection import Brief, Diagnostics, brief, grouped
from gazelle.diagnostics.diagnostic import Diagnostic, Severity, SourceSpan
from gazelle.diagnostics.render import render, render_text
from gazelle.diagnostics.suggestions import did_you_mean, nearest_names

__all__ = [
    "Brief",
    "Diagnostic",
    "Diagnostics",
    "Severity",
    "SourceSpan",
    "brief",
    "did_you_mean",
    "grouped",
    "nearest_names",
    "render",
    "render_text",
]
