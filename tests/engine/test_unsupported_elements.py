"""What ODE's solver would use and this one does not is said once for all who set it."""

from __future__ import annotations

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
from gazelle.engine.unsupported_elements import report_ignored_parameters


def _link(name: str, surface: Surface) -> Link:
    collision = Collision("box", Box((1.0, 1.0, 1.0)), surface=surface)
    return Link(name, inertial=Inertial(1.0), collisions=(collision,))


def _findings(*links: Link, joints: tuple[Joint, ...] = ()) -> list[tuple[str, str]]:
    diagnostics = Diagnostics()
    world = World(models=(Model("m", links=links, joints=joints),))
    report_ignored_parameters(world, diagnostics)
    report_ignored_parameters(world, diagnostics)
    return [(item.code, item.message) for item in diagnostics]


def test_plain_surfaces_are_not_mentioned() -> None:
    assert _findings(_link("a", Surface(mu1=0.5, kp=1e6, kd=1.0))) == []


def test_words_of_several_collisions_are_one_finding() -> None:
    surface = Surface(min_depth_m=0.001, soft_erp=0.1)
    assert _findings(_link("a", surface), _link("b", surface)) == [
        (
            "engine.idle-contact-word",
            "minDepth, soft_erp of collision 'm::a::box' and 1 more have no effect",
        )
    ]


def test_soft_joints_are_named() -> None:
    joint = Joint("j", JointType.REVOLUTE, "a", "b", axis=JointAxis(), cfm=0.1)
    assert _findings(_link("a", Surface()), joints=(joint,)) == [
        ("engine.idle-joint-word", "cfm of joint 'm::j' has no effect")
    ]
