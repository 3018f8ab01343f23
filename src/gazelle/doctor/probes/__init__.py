"""Short runs of physics that show what no reading of files can."""

from __future__ import annotations

from gazelle.doctor.probes.robot_motion import stood_on_ground
from gazelle.doctor.probes.run_probes import run_probes

__all__ = ["run_probes", "stood_on_ground"]
