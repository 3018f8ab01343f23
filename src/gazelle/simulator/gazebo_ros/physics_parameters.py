"""The world's physics settings: step, rate and gravity act, ODE's words are only kept.

In ROS 1 they are ``/gazebo``'s dynamic parameters too; ROS 2 has no dynamic_reconfigure.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.graph.gazebo_names import SHOWN_SPACE
from gazelle.simulator.plugins.dynamic_reconfigure import DynamicParameter, DynamicParameters

if TYPE_CHECKING:
    from gazelle.simulator.plugins.context import Resources
    from gazelle.simulator.world_server import WorldServer

__all__ = ["PhysicsParameters"]

_ACTING = ("time_step", "max_update_rate", "gravity_x", "gravity_y", "gravity_z")
_NANOSECOND_S = 1e-9
_ODE = "A word of ODE; kept and returned, MuJoCo does the physics."


class PhysicsParameters:
    """The one place that physics settings are changed through."""

    def __init__(self, server: WorldServer, resources: Resources, space: str) -> None:
        self._server = server
        rows = _rows(server)
        self._rows = {row.name: row for row in rows}
        self._own: dict[str, Any] = {row.name: row.default for row in rows}
        self._dynamic = (
            DynamicParameters(resources, server, space, rows, changed=self._apply)
            if space == SHOWN_SPACE
            else None
        )

    @property
    def values(self) -> dict[str, Any]:
        """Present values by name."""
        return self._own if self._dynamic is None else self._dynamic.values

    def problem_of(self, values: dict[str, Any]) -> str:
        """Return why these values cannot be set, or nothing; words of ODE are only kept."""
        for name in _ACTING:
            row, value = self._rows[name], float(values[name])
            low, high = float(row.minimum), float(row.maximum)
            if name == "time_step":
                # Time is counted in whole ones.
                low = _NANOSECOND_S
            if not low <= value <= high:
                text = f"it has to be at least {low:g} and at most {high:g}"
                return f"field '{name}' is {value:g}, {text}"
        return ""

    def set(self, values: dict[str, Any]) -> tuple[str, ...]:
        """Change some values, as ``set_physics_properties`` does.

        Returns:
            the names of those that have changed and have no effect here.
        """
        before = dict(self.values)
        self.values.update(values)
        self._apply(self.values)
        if self._dynamic is not None:
            self._dynamic.announce()
        return tuple(
            name for name in values if name not in _ACTING and values[name] != before[name]
        )

    def _apply(self, values: dict[str, Any]) -> None:
        server, engine = self._server, self._server.engine
        gravity = tuple(float(values[f"gravity_{axis}"]) for axis in "xyz")
        if gravity != engine.gravity_m_s2:
            engine.set_gravity((gravity[0], gravity[1], gravity[2]))
        step_s = float(values["time_step"])
        if 0 < round(step_s / _NANOSECOND_S) != engine.step_ns:
            server.set_step(step_s)
        server.set_update_rate(float(values["max_update_rate"]))


def _rows(server: WorldServer) -> tuple[DynamicParameter, ...]:
    physics, engine = server.engine.world.physics, server.engine
    gravity = engine.gravity_m_s2

    def ode(
        name: str, kind: str, value: bool | float, most: float | None = 1e7
    ) -> DynamicParameter:
        low = None if most is None else 0.0
        if kind == "int" and most is not None:
            # The message's field is an integer, and takes nothing else.
            return DynamicParameter(name, kind, int(value), _ODE, 0, int(most))
        return DynamicParameter(name, kind, value, _ODE, low, most)

    return (
        DynamicParameter("time_step", "double", engine.step_ns * 1e-9, "Step, seconds.", 0.0, 10.0),
        DynamicParameter(
            "max_update_rate",
            "double",
            physics.real_time_update_rate_hz,
            "Steps per real second, 0 for as fast as possible.",
            0.0,
            1e6,
        ),
        *(
            DynamicParameter(f"gravity_{axis}", "double", value, "Gravity, m/s².", -100.0, 100.0)
            for axis, value in zip("xyz", gravity, strict=True)
        ),
        ode("auto_disable_bodies", "bool", False, None),
        ode("sor_pgs_precon_iters", "int", physics.solver_precon_iters),
        ode("sor_pgs_iters", "int", physics.solver_iters),
        ode("sor_pgs_w", "double", physics.solver_sor),
        ode("sor_pgs_rms_error_tol", "double", physics.solver_rms_error_tol),
        ode("cfm", "double", physics.cfm),
        ode("erp", "double", physics.erp),
        ode("contact_surface_layer", "double", physics.contact_surface_layer_m),
        ode("contact_max_correcting_vel", "double", physics.contact_max_correcting_vel_m_s),
        ode("max_contacts", "int", physics.max_contacts),
    )
