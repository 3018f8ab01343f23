"""Scans from pictures and clouds, and what is taken out of scans."""

from __future__ import annotations

from gazelle.navigation.laser_scans.laser_filters import (
    FILTERS,
    REFUSED_FILTERS,
    FilterSetup,
    ScanArrays,
    ScanFilter,
    apply_chain,
)
from gazelle.navigation.laser_scans.scan_projection import (
    CloudSlice,
    FlatScan,
    scan_of_depth,
    scan_of_points,
)

__all__ = [
    "FILTERS",
    "REFUSED_FILTERS",
    "CloudSlice",
    "FilterSetup",
    "FlatScan",
    "ScanArrays",
    "ScanFilter",
    "apply_chain",
    "scan_of_depth",
    "scan_of_points",
]
