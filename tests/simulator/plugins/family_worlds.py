"""Families of plug-ins that stand in a world."""

from __future__ import annotations

from typing import Any

import pytest
from tests.simulator.plugins.family_trial import HERE, KEYS, FamilyRow, Trial

from gazelle.interfaces import service_type

__all__ = ["ROWS"]

_WORLD = f"""<sdf version="1.6"><world name="default">
  <plugin name="p" filename="{HERE}">{KEYS}</plugin>
  <model name="ball"><pose>4 0 1 0 0 0</pose>
    <link name="link"><inertial><mass>2</mass></inertial></link></model>
</world></sdf>"""
_DEMO = "<ros><namespace>/demo</namespace></ros>"


def _answer(trial: Trial, name: str, kind: str, /, **fields: Any) -> Any:
    below = "/demo" if trial.is_ros2 else ""
    request = service_type(f"gazebo_msgs/{kind}").Request(**fields)
    server: Any = trial.sim.server
    return server.node.call(f"{below}/{name}", request)


def states(trial: Trial) -> None:
    """A model stands where the world has it, and is published at the rate."""
    models = trial.listen(("/demo" if trial.is_ros2 else "") + "/model_states")
    state = _answer(trial, "get_entity_state", "GetEntityState", name="ball").state
    assert (state.pose.position.x, state.pose.position.z) == pytest.approx((4.0, 1.0))
    trial.sim.run(seconds=1.0)
    assert len(models) == (20 if trial.keys else 100)
    assert models[-1].name == ["ball"]


def properties(trial: Trial) -> None:
    """A link weighs what the world says, then what is asked for."""
    name = "ball::link"
    link = _answer(trial, "get_link_properties", "GetLinkProperties", link_name=name)
    assert link.mass == 2.0
    kept = {field: getattr(link, field) for field in ("com", "ixx", "iyy", "izz")}
    kind = "SetLinkProperties"
    assert _answer(trial, "set_link_properties", kind, link_name=name, mass=3.0, **kept).success
    assert _answer(trial, "get_link_properties", "GetLinkProperties", link_name=name).mass == 3.0


ROWS = (
    FamilyRow("gazebo_ros_state", _WORLD, states, ("", f"{_DEMO}<update_rate>20</update_rate>")),
    FamilyRow("gazebo_ros_properties", _WORLD, properties, ("", _DEMO)),
)
