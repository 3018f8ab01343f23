"""Short runs of physics that show what no reading of files can."""

from __future__ import annotations

from gazelle.doctor.probes.all_probes import run_probes

__all__ = ["run_probes"]
