"""Every probe, one after the other, in a simulation of its own."""

from __future__ import annotations

from collections.abc import Callable

from gazelle.description.model import World
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.probes.idle_drift import probe_idle_drift
from gazelle.doctor.probes.robots import robots_of
from gazelle.doctor.report import Section
from gazelle.errors import SimulationDivergedError
from gazelle.simulator.parameter_input import Parameters
from gazelle.simulator.simulation import Simulation
from gazelle.workspace import Workspace

__all__ = ["run_probes"]


def run_probes(
    world: World,
    *,
    workspace: Workspace,
    parameters: Parameters | None = None,
    diagnostics: Diagnostics,
    progress: Callable[[str], None] | None = None,
    seed: int = 0,
) -> tuple[Section, ...]:
    """Let a world run for some seconds of simulated time and report what its robots do.

    Args:
        world: with the robots in it, at the poses where they are spawned.
        workspace: finds packages and models.
        parameters: of controllers and plug-ins, as `Simulation` takes them.
        diagnostics: receives the findings; not those of building the world.
        progress: told before each probe.
        seed: of all noise.

    Returns:
        a table for each probe that had something to look at.
    """
    tell = progress or (lambda text: None)
    robots = robots_of(world)
    if not robots:
        return ()
    unheard = Diagnostics()
    sections = []
    with Simulation(
        world, workspace=workspace, diagnostics=unheard, seed=seed, parameters=parameters
    ) as simulation:
        try:
            tell("probe: idle drift")
            sections.append(probe_idle_drift(simulation, robots, diagnostics))
        except SimulationDivergedError as error:
            diagnostics.report("probe.diverged", str(error))
    return tuple(section for section in sections if section.rows)
