"""Masses and inertias that files get wrong."""

from __future__ import annotations

from dataclasses import replace

import pytest

from gazelle.description.model import (
    Box,
    Collision,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
    World,
)
from gazelle.diagnostics import Diagnostics
from gazelle.engine import Engine
from gazelle.geometry import Pose

SMALL = Inertial(1.0, inertia_kg_m2=(0.01, 0, 0, 0.01, 0, 0.01))


def engine_of(model):
    diagnostics = Diagnostics()
    return Engine(World(models=(model,)), diagnostics=diagnostics), diagnostics


def test_massless_root_with_a_fixed_massive_child_falls():
    """SLAMBOT's base_footprint."""
    links = (Link("footprint"), Link("base", Pose((0, 0, 0.1)), inertial=SMALL))
    joint = Joint("j", JointType.FIXED, "footprint", "base")
    engine, diagnostics = engine_of(Model("m", links=links, joints=(joint,)))
    engine.step(1000)
    assert engine.link("m::footprint").T_world_link().position_m[2] == pytest.approx(-4.9, rel=2e-3)
    assert len(diagnostics) == 0


def test_moving_leaf_without_mass_gets_a_gram_and_is_reported():
    links = (Link("base", inertial=SMALL), Link("leaf"))
    joint = Joint("j", JointType.CONTINUOUS, "base", "leaf", axis=JointAxis())
    engine, diagnostics = engine_of(Model("m", links=links, joints=(joint,)))
    engine.step(10)
    assert engine.link("m::leaf").mass_kg == 0.001
    (finding,) = diagnostics.by_code("engine.massless-link")
    assert "link 'm::leaf' moves and has no mass" in finding.message


@pytest.mark.parametrize("tensor", [(1, 0, 0, 1, 0, 5), (0, 0, 0, 0, 0, 0), (-1, 0, 0, 1, 0, 1)])
def test_impossible_inertia_becomes_a_spheres_and_is_reported(tensor):
    link = Link("l", inertial=Inertial(1.0, inertia_kg_m2=tensor))
    engine, diagnostics = engine_of(Model("m", links=(link,)))
    engine.step(10)
    (finding,) = diagnostics.by_code("engine.illegal-inertia")
    assert "link 'm::l' has an inertia no body can have" in finding.message
    moments = engine.model.body_inertia[engine.body_id("m::l")]
    assert moments == pytest.approx([moments[0]] * 3) and moments[0] > 0


@pytest.mark.parametrize("moment", [1e-14, 1e-16, 1e-30])
def test_inertia_below_what_mujoco_tells_from_nothing_is_raised(moment):
    """Thrusters and lenses have such ones, and Gazebo takes them."""
    tensor = (moment, 0, 0, moment, 0, moment)
    link = Link("l", inertial=Inertial(1e-7, inertia_kg_m2=tensor))
    engine, diagnostics = engine_of(Model("m", links=(link,)))
    assert engine.model.body_inertia[engine.body_id("m::l")] == pytest.approx([1e-13] * 3)
    assert len(diagnostics) == 0


def test_rotated_inertia_keeps_its_moments():
    turned = Pose.from_xyz_rpy((0.1, 0, 0), (0.3, -0.4, 1.0))
    link = Link("l", inertial=Inertial(2.0, turned, (0.1, 0, 0, 0.2, 0, 0.25)))
    engine, diagnostics = engine_of(Model("m", links=(link,)))
    moments = sorted(engine.model.body_inertia[engine.body_id("m::l")])
    assert moments == pytest.approx([0.1, 0.2, 0.25])
    assert len(diagnostics) == 0


@pytest.mark.parametrize("turn", [0.0, 0.3, 1.1])
@pytest.mark.parametrize("low", [0.02, 0.019999999999999997, 0.0199999999])
def test_flat_bodies_whose_moments_add_up_exactly_are_built(low, turn):
    turned = Pose.from_xyz_rpy((0, 0, 0), (turn, -turn, 2 * turn))
    link = Link("l", inertial=Inertial(2.0, turned, (low, 0, 0, low, 0, 0.04)))
    engine, diagnostics = engine_of(Model("m", links=(link,)))
    moments = sorted(engine.model.body_inertia[engine.body_id("m::l")])
    assert moments == pytest.approx([0.02, 0.02, 0.04], rel=1e-6)
    assert len(diagnostics) == 0


def test_velocity_decay_of_a_jointed_link_is_reported():
    links = (Link("a", inertial=SMALL), Link("b", inertial=SMALL, linear_damping=0.1))
    joint = Joint("j", JointType.CONTINUOUS, "a", "b", axis=JointAxis())
    _, diagnostics = engine_of(Model("m", links=links, joints=(joint,)))
    (finding,) = diagnostics.by_code("engine.velocity-decay")
    assert "link 'm::b' has a velocity_decay" in finding.message


def test_collisions_of_one_name_are_both_kept(build):
    model = build.block()
    cube = Collision("box", Box((0.1, 0.1, 0.1)))
    link = replace(model.links[0], collisions=(cube, cube))
    engine, _ = engine_of(replace(model, links=(link,)))
    assert engine.model.ngeom == 2
