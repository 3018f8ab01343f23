"""Bags into files that other programs read: CSV, Parquet, PNG, MP4."""

from __future__ import annotations

from gazelle.bag.export.exporting import FORMATS, export_bag

__all__ = ["FORMATS", "export_bag"]
