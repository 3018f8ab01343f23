"""Codes of the doctor's probes: short runs of physics."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "probe.diverged",
        "error",
        "The simulation diverges within seconds",
        "A position or speed became no finite number. Gazebo shows such a robot nowhere, or "
        "stops; the message names link and line.",
        "check mass, inertia, gains and overlapping collisions of the link named",
        "ODE INTERNAL ERROR 1: assertion \"bNormalizationResult\" failed",
    ),
    Entry(
        "probe.idle-drift",
        "warning",
        "A robot that nobody commands moves",
        "An idle robot stays within 1 mm and 0.1° in 10 s. One that does not stands on a slope, "
        "is driven by something, is not at rest yet, or has wheels or contacts that creep.",
        "look at the contacts named: round wheels, friction mu1 and mu2 of 1, no overlaps; give "
        "free joints a damping",
        "robot slides, sinks, jitters or drifts slowly",
    ),
)
