"""Short simulations of what has come up, when they are asked for."""

from __future__ import annotations

from gazelle.doctor.dry_start import DryStart, StartPlan
from gazelle.doctor.examination import Examination

__all__ = ["probe"]


def probe(start: DryStart, plan: StartPlan, examination: Examination) -> None:
    """Run the probes over a world with its parameters; nothing unless the options say so."""
    if not examination.options.probe:
        return
    from gazelle.doctor.probes import run_probes

    sections = run_probes(
        start.world,
        workspace=examination.workspace,
        parameters=plan.parameters,
        diagnostics=examination.diagnostics,
        progress=examination.say,
    )
    examination.add(*sections)
