"""Every probe, one after the other, in one simulation of its own."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence

from gazelle.description.model import Model, World
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.dry_start.plan import DryNode
from gazelle.doctor.probes.controllers import probe_controllers
from gazelle.doctor.probes.drive import probe_drive, twist_topics
from gazelle.doctor.probes.idle_drift import FALLS, probe_idle_drift
from gazelle.doctor.probes.robot_motion import robots_of
from gazelle.doctor.probes.spawn import probe_spawn
from gazelle.doctor.report import Section
from gazelle.errors import EngineError, SimulationDivergedError
from gazelle.simulator.simulation import Simulation
from gazelle.simulator.simulation_parameters import Parameters
from gazelle.workspace import Workspace

__all__ = ["run_probes"]

Tell = Callable[[str], None]


def run_probes(
    world: World,
    *,
    workspace: Workspace,
    parameters: Parameters | None = None,
    diagnostics: Diagnostics,
    progress: Tell | None = None,
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

    Raises:
        GazelleError: a parameter file cannot be read.
    """
    robots = robots_of(world)
    if not robots:
        return ()
    sections: list[Section] = []
    node, unheard = DryNode(), Diagnostics()
    try:
        with Simulation(
            world,
            workspace=workspace,
            diagnostics=unheard,
            node=node,
            seed=seed,
            parameters=parameters,
        ) as simulation:
            for section in _probed(simulation, node, robots, diagnostics, progress or _silent):
                sections.append(section)
    except SimulationDivergedError as error:
        diagnostics.report("probe.diverged", str(error), _span_of(str(error), robots))
    except EngineError as error:
        diagnostics.report("probe.not-built", f"the world cannot be built: {error}", world.span)
    for item in unheard.by_code("plugin.user-error"):
        diagnostics.add(item)
    return tuple(section for section in sections if section.rows)


def _probed(
    simulation: Simulation,
    node: DryNode,
    robots: Sequence[Model],
    diagnostics: Diagnostics,
    tell: Tell,
) -> Iterator[Section]:
    tell("probe: spawn")
    yield probe_spawn(simulation, robots, diagnostics)
    tell("probe: idle drift")
    drift = probe_idle_drift(simulation, robots, diagnostics)
    yield drift
    fallen = {row[0] for row in drift.rows if row[-1] == FALLS}
    robots = [robot for robot in robots if robot.name not in fallen]
    if not robots:
        return
    # From the start again: an arm that hangs down by now would hide that it sags.
    simulation.reset()
    if simulation.server.controls.managers:
        tell("probe: controllers")
        yield probe_controllers(simulation, robots, diagnostics)
    topics = twist_topics(node.heard)
    if topics:
        tell("probe: velocity commands")
        yield probe_drive(simulation, robots, topics, diagnostics)


def _span_of(text: str, robots: Sequence[Model]) -> SourceSpan | None:
    """Return the place of the link that an error names as ``model::link``."""
    named = re.search(r"link '([^']+)::([^':]+)'", text)
    if named is None:
        return None
    for robot in robots:
        link = robot.link(named[2]) if robot.name == named[1] else None
        if link is not None:
            return link.span
    return None


def _silent(text: str) -> None:
    """Take progress that nobody wants to hear."""
