"""Who touches whom, and what of a surface cannot be mapped."""

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
    Surface,
    World,
)
from gazelle.diagnostics import Diagnostics
from gazelle.engine import Engine
from gazelle.engine.contact_pairs import CollisionKind, assign_groups, may_touch
from gazelle.engine.contact_solref_solimp import contact_spring
from gazelle.engine.surface_combination import combine
from gazelle.geometry import Pose

CUBE = Collision("c", Box((0.2, 0.2, 0.2)))
SMALL = Inertial(1.0, inertia_kg_m2=(0.01, 0, 0, 0.01, 0, 0.01))


def pile(self_collide=False, count=2):
    """Cubes inside each other that belong to one model without joints."""
    links = tuple(
        Link(f"l{i}", Pose((0.05 * i, 0, 0)), inertial=SMALL, collisions=(CUBE,))
        for i in range(count)
    )
    return Model("pile", links=links, self_collide=self_collide)


def diagnostics_of(*models):
    diagnostics = Diagnostics()
    Engine(World(models=models), diagnostics=diagnostics)
    return diagnostics


def test_links_of_one_model_do_not_touch_by_default(build):
    engine = build.engine(pile(), gravity_m_s2=(0, 0, 0))
    engine.step(10)
    assert engine.contacts() == ()


def test_self_collide_lets_links_of_one_model_touch(build):
    engine = build.engine(pile(self_collide=True), gravity_m_s2=(0, 0, 0))
    engine.step(1)
    assert {c.collision1 for c in engine.contacts()} == {"pile::l0::c"}


def test_one_link_with_self_collide_is_not_enough(build):
    model = pile()
    first = replace(model.links[0], self_collide=True)
    engine = build.engine(replace(model, links=(first, model.links[1])), gravity_m_s2=(0, 0, 0))
    engine.step(1)
    assert engine.contacts() == ()


def test_a_crowd_of_boxes_gets_pairs_with_the_ground_only(build):
    crowd = [build.block(f"b{i}", Pose((i, 0, 0.1))) for i in range(300)]
    engine = build.engine(build.ground(), *crowd)
    assert engine.model.npair == 300
    engine.step(1000)
    assert (engine.data.tree_asleep >= 0).all()


def test_links_joined_by_a_joint_do_not_touch_even_with_self_collide(build):
    joint = Joint("j", JointType.PRISMATIC, "l0", "l1", axis=JointAxis((0, 0, 1)))
    model = replace(pile(self_collide=True), joints=(joint,))
    engine = build.engine(model, gravity_m_s2=(0, 0, 0))
    engine.step(1)
    assert engine.contacts() == ()


@pytest.mark.parametrize(("masks", "touch"), [((1, 2), False), ((3, 2), True), ((None, 4), True)])
def test_collide_bitmask_decides_by_its_and(build, masks, touch):
    models = [
        build.block(f"b{i}", Pose((0.05 * i, 0, 0)), collide_bitmask=mask)
        for i, mask in enumerate(masks)
    ]
    engine = build.engine(*models, gravity_m_s2=(0, 0, 0))
    engine.step(1)
    assert bool(engine.contacts()) == touch


def test_collide_without_contact_reports_and_does_not_push(build):
    engine = build.engine(build.ground(), build.block(collide_without_contact=True))
    engine.step(50)
    (contact,) = engine.contacts()
    assert contact.forces_n == pytest.approx(0.0)
    assert engine.model_velocity("block")[0][2] == pytest.approx(-0.05 * build.G)


def test_more_models_than_bits_still_obey_the_rules(build):
    crowd = [
        replace(pile(), name=f"pile{i}", T_world_model=Pose((0, 2.0 * i, 0.1))) for i in range(40)
    ]
    on_top = build.block("top", Pose((0, 2.0 * 39, 0.31)))
    engine = build.engine(build.ground(), *crowd, on_top)
    engine.step(100)
    pairs = {(c.collision1.split("::")[0], c.collision2.split("::")[0]) for c in engine.contacts()}
    assert all(first != second for first, second in pairs)
    assert any("top" in pair for pair in pairs)


def test_bits_say_exactly_who_touches():
    kinds = [CollisionKind("a"), CollisionKind("b", 1), CollisionKind("", 2), CollisionKind("")]
    kinds.append(CollisionKind("a", touches_itself=True))
    groups, sharing_bits = assign_groups(kinds)
    assert not sharing_bits
    for one in kinds:
        for other in kinds:
            first, second = groups[one], groups[other]
            bits = (first.contype & second.conaffinity) | (second.contype & first.conaffinity)
            assert (bits != 0) == may_touch(one, other)


def test_surfaces_combine_as_in_gazebo():
    pair = combine(
        Surface(mu1=0.5, mu2=2.0, kp=1e5, kd=3.0, torsional_mu=0.4),
        Surface(mu1=0.8, mu2=1.0, kp=3e5, kd=4.0, torsional_patch_radius_m=0.1),
    )
    assert (pair.mu1, pair.mu2) == (0.5, 1.0)
    assert pair.kp == pytest.approx(0.75e5)
    assert pair.kd == 7.0
    assert pair.torsional_m == pytest.approx(3 * 3.141592653589793 / 16 * 0.1 * 0.4)
    assert pair.condim == 4


def test_soft_contact_is_the_implicit_step_of_ode():
    """One step of MuJoCo's row from depth x and speed v equals ODE's with ERP and CFM."""
    pair, mass, step = combine(Surface(kp=2e4, kd=30.0, max_vel_m_s=100.0), Surface()), 2.0, 0.001
    spring = contact_spring(pair, 1 / mass, step)
    depth, speed, free = 0.003, -0.2, -9.8
    d = spring.solimp[0]
    k, b = -spring.solref[0] / d, -spring.solref[1] / d
    mujoco_acceleration = (1 - d) * free + d * (-b * speed + k * depth)
    c = 1 + step * (pair.kd + step * pair.kp) / mass
    push = pair.kp * depth - (pair.kd + step * pair.kp) * speed
    assert mujoco_acceleration == pytest.approx((free + push / mass) / c, rel=1e-9)


def test_torsional_friction_stops_a_spinning_ball(build):
    patch = {"torsional_mu": 1.0, "torsional_patch_radius_m": 0.02}
    engine = build.engine(build.ground(), build.ball(**patch))
    engine.step(300)
    engine.set_model_velocity("ball", (0, 0, 0), (0, 0, 10.0))
    engine.step(300)
    torque = 3 * 3.14159 / 16 * 0.02 * build.G
    wanted = 10 - torque / (0.4 * 0.01) * 0.3
    assert engine.model_velocity("ball")[1][2] == pytest.approx(wanted, rel=0.05)


def test_friction_direction_is_reported(build):
    found = diagnostics_of(build.block(fdir1=(1.0, 0, 0), mu1=0.1, mu2=0.5))
    (finding,) = found.by_code("engine.friction-direction")
    assert "collision 'block::link::box' sets fdir1" in finding.message


def test_slip_is_reported(build):
    (finding,) = diagnostics_of(build.block(slip1=0.5)).by_code("engine.slip")
    assert "sets slip1 0.5 and slip2 0" in finding.message


def test_limit_of_contact_points_is_reported(build):
    (finding,) = diagnostics_of(build.block(max_contacts=1)).by_code("engine.max-contacts")
    assert "allows 1 contact points" in finding.message
