"""Models by the names of their parts."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.model import Joint, JointType, Link, Model

FIRST, SECOND = Link("a"), Link("a", visuals=())
JOINT = Joint("j", JointType.FIXED, parent="a", child="b")
MODEL = Model("m", links=(FIRST, SECOND, Link("b")), joints=(JOINT,))


def test_parts_are_found_by_name_the_first_of_several() -> None:
    assert MODEL.link("a") is FIRST
    assert MODEL.joint("j") is JOINT
    assert MODEL.link("j") is None
    assert MODEL.joint("a") is None


def test_a_changed_model_finds_its_own_parts() -> None:
    assert MODEL.link("b") is not None
    changed = replace(MODEL, links=(SECOND,), joints=())
    assert changed.link("a") is SECOND
    assert changed.link("b") is None
    assert changed.joint("j") is None


def test_what_was_looked_up_makes_no_difference() -> None:
    other = Model("m", links=MODEL.links, joints=MODEL.joints)
    assert MODEL.link("a") is FIRST
    assert other == MODEL
    assert hash(other) == hash(MODEL)
    assert repr(other) == repr(MODEL)
