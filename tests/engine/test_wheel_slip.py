"""Wheels that slip in proportion to the force on them."""

from __future__ import annotations

import math

import pytest

from gazelle.description.model import (
    Collision,
    Cylinder,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
    Surface,
)
from gazelle.errors import EngineError
from gazelle.geometry import Pose

RADIUS = 0.1
WHEELS = {f"{x}{y}": (0.2 * (1 if x == "f" else -1), 0.15 * (1 if y == "l" else -1))
          for x in "fr" for y in "lr"}  # fmt: skip


def cart(self_collide: bool = False, mu: float = 1.0, **slip) -> Model:
    """Four wheels under a body, 10 kg together."""
    body = Inertial(6.0, inertia_kg_m2=(0.05, 0, 0, 0.1, 0, 0.15))
    disc = Inertial(1.0, inertia_kg_m2=(0.003, 0, 0, 0.005, 0, 0.003))
    links, joints = [Link("body", Pose((0, 0, RADIUS)), inertial=body)], []
    lying = Pose.from_xyz_rpy((0, 0, 0), (math.pi / 2, 0, 0))
    for name, (x, y) in WHEELS.items():
        pose = Pose((x, y, RADIUS))
        tread = Collision(
            "tread", Cylinder(RADIUS, 0.05), lying, surface=Surface(mu1=mu, mu2=mu, **slip)
        )
        links.append(Link(name, pose, inertial=disc, collisions=(tread,)))
        axis = JointAxis((0, 1, 0))
        joints.append(Joint(name, JointType.CONTINUOUS, "body", name, pose, axis=axis))
    return Model("cart", links=tuple(links), joints=tuple(joints), self_collide=self_collide)


def slipping(build, lateral: float, longitudinal: float, **options):
    engine = build.engine(build.ground(), cart(**options))
    for name in WHEELS:
        engine.set_wheel_slip(f"cart::{name}", lateral, longitudinal, RADIUS)
    return engine


@pytest.mark.parametrize("slip", [1e-3, 0.02])
@pytest.mark.parametrize("self_collide", [False, True])
def test_pushed_sideways_a_wheel_slides_at_slip_times_its_force(build, slip, self_collide):
    engine = slipping(build, slip, 0.0, self_collide=self_collide)
    engine.step(200)
    engine.link("cart::body").apply_wrench((0.0, 20.0, 0.0), point_link_m=(0, 0, -RADIUS))
    engine.step(1500)
    speed = engine.link("cart::body").velocity_world().linear_m_s[1]
    assert speed == pytest.approx(slip * 20.0 / 4, rel=0.01)


@pytest.mark.parametrize("slip", [1e-3, 0.02])
def test_braked_wheels_slide_forward_at_slip_times_their_force(build, slip):
    engine = slipping(build, 0.0, slip)
    for name in WHEELS:
        engine.joint(f"cart::{name}").lock_position(0.0)
    engine.link("cart::body").apply_wrench((20.0, 0.0, 0.0), point_link_m=(0, 0, -RADIUS))
    engine.step(1500)
    speed = engine.link("cart::body").velocity_world().linear_m_s[0]
    assert speed == pytest.approx(slip * 20.0 / 4, rel=0.01)


def test_driven_wheels_turn_faster_than_they_roll_under_load(build):
    engine = slipping(build, 0.0, 0.01)
    for name in WHEELS:
        engine.joint(f"cart::{name}").set_velocity_target(5.0, 100.0)
    engine.link("cart::body").apply_wrench((-40.0, 0.0, 0.0), point_link_m=(0, 0, -RADIUS))
    engine.step(2000)
    speed = engine.link("cart::body").velocity_world().linear_m_s[0]
    assert speed == pytest.approx(5.0 * RADIUS - 0.01 * 10.0, rel=0.01)


def test_force_beyond_friction_slides_freely_whatever_the_slip(build):
    engine = slipping(build, 1e-3, 1e-3, mu=0.2)
    engine.step(100)
    engine.link("cart::body").apply_wrench((0.0, 40.0, 0.0), point_link_m=(0, 0, -RADIUS))
    engine.step(500)
    before = engine.link("cart::body").velocity_world().linear_m_s[1]
    engine.step(500)
    gained = engine.link("cart::body").velocity_world().linear_m_s[1] - before
    assert gained == pytest.approx((40.0 - 0.2 * 10 * build.G) / 10 * 0.5, rel=0.05)


def test_wheels_without_slip_stand_as_without_tyres(build):
    engine = slipping(build, 0.0, 0.0)
    engine.link("cart::body").apply_wrench((0.0, 20.0, 0.0), point_link_m=(0, 0, -RADIUS))
    engine.step(1000)
    position = engine.link("cart::body").T_world_link().position_m
    assert position[1] == pytest.approx(0.0, abs=2e-4)
    assert position[2] == pytest.approx(RADIUS, abs=2e-4)
    names = {
        name for contact in engine.contacts() for name in (contact.collision1, contact.collision2)
    }
    assert "cart::fl::tread" in names


def test_slip_changes_while_running_and_comes_back_with_a_saved_state(build):
    engine = slipping(build, 1e-3, 0.0)
    engine.link("cart::body").apply_wrench((0.0, 20.0, 0.0), point_link_m=(0, 0, -RADIUS))
    engine.step(1000)
    revision, saved = engine.revision, engine.save_state()
    for name in WHEELS:
        engine.set_wheel_slip(f"cart::{name}", 4e-3, 0.0, RADIUS)
    engine.step(1000)
    assert engine.revision == revision
    speed = engine.link("cart::body").velocity_world().linear_m_s[1]
    assert speed == pytest.approx(4e-3 * 5.0, rel=0.01)
    engine.restore_state(saved)
    engine.step(1000)
    speed = engine.link("cart::body").velocity_world().linear_m_s[1]
    assert speed == pytest.approx(1e-3 * 5.0, rel=0.01)
    engine.delete("cart")
    engine.step(10)


def test_only_turning_joints_carry_wheels(build):
    engine = build.engine(build.arm(JointType.PRISMATIC))
    with pytest.raises(EngineError, match="carries no wheel that could slip"):
        engine.set_wheel_slip("arm::joint", 0.1, 0.1, 0.1)
    engine = build.engine(build.wheel())
    with pytest.raises(EngineError, match="positive numbers are needed"):
        engine.set_wheel_slip("wheel::joint", -0.1, 0.1, 0.1)


def test_slip_of_a_wheels_surface_acts_along_its_axle(build):
    model = cart(slip1=2e-3, slip2=0.0, fdir1=(0.0, 0.0, 1.0))
    engine = build.engine(build.ground(), model)
    assert "engine.slip" not in {item.code for item in engine.diagnostics}
    engine.link("cart::body").apply_wrench((0.0, 20.0, 0.0), point_link_m=(0, 0, -RADIUS))
    engine.step(1500)
    speed = engine.link("cart::body").velocity_world().linear_m_s
    assert speed[1] == pytest.approx(2e-3 * 5.0, rel=0.01)
    engine.delete("cart")
    engine.spawn(cart(), name="cart")
    engine.link("cart::body").apply_wrench((0.0, 20.0, 0.0), point_link_m=(0, 0, -RADIUS))
    engine.step(500)
    speed = engine.link("cart::body").velocity_world().linear_m_s
    assert speed[1] == pytest.approx(0.0, abs=1e-3)


def test_unequal_slip_without_a_direction_is_reported(build):
    engine = build.engine(build.ground(), cart(slip1=2e-3, slip2=0.0))
    (finding, *_) = engine.diagnostics.by_code("engine.slip")
    assert "lets only wheels slip" in finding.message
