"""Findings about users' files: places, severities, collecting and rendering them."""

from __future__ import annotations

from gazelle.diagnostics.collection import Brief, Diagnostics, brief, grouped, groups
from gazelle.diagnostics.diagnostic import Diagnostic, Severity, SourceSpan
from gazelle.diagnostics.render import SourceLines, render, render_text, styled
from gazelle.diagnostics.suggestions import did_you_mean, nearest_names

__all__ = [
    "Brief",
    "Diagnostic",
    "Diagnostics",
    "Severity",
    "SourceLines",
    "SourceSpan",
    "brief",
    "did_you_mean",
    "grouped",
    "groups",
    "nearest_names",
    "render",
    "render_text",
    "styled",
]
