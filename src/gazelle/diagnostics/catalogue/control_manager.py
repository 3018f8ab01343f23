"""Codes of the controller manager."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "control.controller-failed",
        "error",
        "A controller failed while it ran",
        "Its update, start or stop raised an error. It is stopped; the other controllers go on.",
        "see the message; for a controller of your own it has file and line",
        "update resulted in an error",
    ),
    Entry(
        "control.update-rate",
        "warning",
        "A controller's wish about when it runs cannot be met",
        "A controller runs at most as often as the controller manager, and in its loop.",
        "lower update_rate, or raise the controller manager's",
        "update rate should be less than or equal to controller manager's update rate",
    ),
)
