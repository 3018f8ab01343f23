"""Recording a simulation of this process, at exact steps of simulated time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Self

from gazelle.recording.recording import Recording
from gazelle.recording.tape import Known, Tape, is_recorded
from gazelle.simulator.intra_process_node import LocalNode
from gazelle.simulator.scheduler import ORDER_STATE, Task, period_in_steps

if TYPE_CHECKING:
    from gazelle.simulator.node_interfaces import SubscriptionPort
    from gazelle.simulator.simulation import Simulation
    from gazelle.simulator.world_server import WorldServer

__all__ = ["SimulationRecorder", "record", "snapshot"]

_RATE_HZ = 50.0
# A robot's plug-ins offer their topics when it comes; a look at them all costs microseconds.
_LOOK_EVERY = 10


class SimulationRecorder:
    """Records while the simulation steps, until `stop` or the end of the ``with`` block.

    Use `record`.
    """

    def __init__(
        self, sim: Simulation, *, rate_hz: float = _RATE_HZ, topics: Sequence[str] | None = None
    ) -> None:
        """Begin with the present moment; see `record`."""
        self._server: WorldServer = sim.server
        self._tape = Tape()
        self._wanted = None if topics is None else tuple(map(sim.server.node.resolve_name, topics))
        self._subscriptions: dict[str, SubscriptionPort] = {}
        self._looks = 0
        self._look()
        period = period_in_steps(rate_hz, self._server.engine.step_ns)
        self._task: Task | None = self._server.scheduler.add(
            Task("recording", period, self._look, ORDER_STATE)
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.stop()

    @property
    def recording(self) -> Recording:
        """What was recorded up to now."""
        found = self._tape.recording()
        assert found is not None
        return found

    def stop(self) -> Recording:
        """Record the present moment and no more; stopping twice does nothing."""
        if self._task is not None:
            self._server.scheduler.remove(self._task)
            self._task = None
            self._take_moment()
            for one in self._subscriptions.values():
                one.unregister()
        return self.recording

    def _look(self) -> None:
        self._take_moment()
        if self._looks % _LOOK_EVERY == 0:
            self._subscribe()
        self._looks += 1

    def _take_moment(self) -> None:
        engine = self._server.engine
        moment = engine.snapshot()
        if not self._tape.knows(engine.revision):
            world = engine.world
            self._tape.know(engine.revision, Known(lambda: world, tuple(moment.link_names)))
        self._tape.add_moment(engine.revision, moment.time_ns, moment.T)

    def _subscribe(self) -> None:
        for name, type_name in _topics(self._server.node).items():
            if name not in self._subscriptions and is_recorded(name, type_name, self._wanted):
                take = self._taker(name, type_name)
                self._subscriptions[name] = self._server.node.create_subscription(
                    name, None, take, inline=True
                )

    def _taker(self, name: str, type_name: str) -> Callable[[Any], None]:
        def take(message: Any) -> None:
            self._tape.add_message(name, type_name, self._server.time_ns, message)

        return take


def record(
    sim: Simulation, *, rate_hz: float = _RATE_HZ, topics: Sequence[str] | None = None
) -> SimulationRecorder:
    """Record a simulation from now on, while it steps.

    Args:
        sim: what steps.
        rate_hz: moments per simulated second.
        topics: which; all but pictures and clouds when None.

    Example:
        >>> with record(sim) as recorder:
        ...     sim.run(seconds=5)
        >>> recorder.recording.duration_s
        5.0
    """
    return SimulationRecorder(sim, rate_hz=rate_hz, topics=topics)


def snapshot(sim: Simulation) -> Recording:
    """Return the present moment as a recording."""
    return SimulationRecorder(sim, topics=()).stop()


def _topics(node: Any) -> dict[str, str]:
    if isinstance(node, LocalNode):
        return node.topics
    return {one.name: one.type_name for one in node.graph.topics()}
