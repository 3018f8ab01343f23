"""Worlds for probes: a fixture's robot, or one of code, on level ground."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from gazelle.description.loader import load_models
from gazelle.description.model import (
    Box,
    Collision,
    Inertial,
    Link,
    Model,
    Plane,
    Surface,
    World,
)
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.probes import run_probes
from gazelle.doctor.report import Section
from gazelle.geometry import Pose
from gazelle.simulator.simulation_parameters import Parameters
from gazelle.workspace import Workspace

FIXTURES = Path(__file__).parents[1] / "fixtures"


def ground(roll_rad: float = 0.0) -> Model:
    """Return a resting plane."""
    pose = Pose.from_xyz_rpy((0.0, 0.0, 0.0), (roll_rad, 0.0, 0.0))
    link = Link("link", collisions=(Collision("collision", Plane()),))
    return Model("ground", T_world_model=pose, static=True, links=(link,), canonical_link="link")


def block(z: float, mu: float = 1.0, moment: float = 0.01) -> Model:
    """Return a cube of 0.2 m and 1 kg."""
    link = Link(
        "block",
        inertial=Inertial(1.0, inertia_kg_m2=(moment, 0, 0, moment, 0, moment)),
        collisions=(Collision("c", Box((0.2, 0.2, 0.2)), surface=Surface(mu1=mu, mu2=mu)),),
    )
    return Model("cube", T_world_model=Pose((0.0, 0.0, z)), links=(link,), canonical_link="block")


def robot(name: str, z: float = 0.0) -> Model:
    """Return a fixture's robot."""
    (model,) = load_models(FIXTURES / name, workspace=None, diagnostics=Diagnostics())
    return replace(model, T_world_model=Pose((0.0, 0.0, z)))


def probed(
    *models: Model,
    parameters: Parameters | None = None,
    gravity_m_s2: tuple[float, float, float] = (0.0, 0.0, -9.8),
) -> tuple[dict[str, Section], Diagnostics]:
    """Return the tables by name, and the findings."""
    found = Diagnostics()
    sections = run_probes(
        World(models=models, gravity_m_s2=gravity_m_s2),
        workspace=Workspace.discover(cwd=FIXTURES),
        parameters=parameters,
        diagnostics=found,
    )
    return {section.name: section for section in sections}, found


ARM = """
<robot name="arm">
  <link name="world"/>
  <link name="lever">
    <inertial>
      <origin xyz="0.5 0 0"/><mass value="1"/>
      <inertia ixx="0.001" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="hinge" type="revolute">
    <parent link="world"/><child link="lever"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="{effort}" velocity="5"/>
  </joint>
  <transmission name="t">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="hinge">
      <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
    </joint>
    <actuator name="m"><mechanicalReduction>1</mechanicalReduction></actuator>
  </transmission>
  <gazebo>
    <plugin name="c" filename="libgazebo_ros_control.so">
      <robotNamespace>/arm</robotNamespace>
    </plugin>
  </gazebo>
</robot>
"""


def arm(effort: float = 50.0) -> Model:
    """Return a level lever of 1 kg with its weight half a metre from a hinge."""
    text = ARM.format(effort=effort)
    (model,) = load_models(text, workspace=None, diagnostics=Diagnostics())
    return model
