"""What is a robot's tree, and what is none."""

from __future__ import annotations

import pytest

from gazelle.description.model import Joint, JointType, Link, Model, World
from gazelle.documents import LimitError
from gazelle.engine import Engine
from gazelle.engine.kinematic_tree import kinematic_tree
from gazelle.errors import NotFoundError


def chain(count: int, kind: JointType = JointType.CONTINUOUS, **options: bool) -> Model:
    """Links that each hang on the one before."""
    links = tuple(Link(f"l{i}") for i in range(count + 1))
    joints = tuple(Joint(f"j{i}", kind, f"l{i - 1}", f"l{i}") for i in range(1, count + 1))
    return Model("m", links=links, joints=joints, **options)


def test_joint_that_makes_a_link_its_own_ancestor_closes_a_loop() -> None:
    model = chain(4)
    ring = Joint("ring", JointType.FIXED, "l4", "l0")
    tree = kinematic_tree(Model("m", links=model.links, joints=(*model.joints, ring)))
    assert [one.name for one in tree.loops] == ["ring"]
    backwards = (ring, *reversed(model.joints))
    tree = kinematic_tree(Model("m", links=model.links, joints=backwards))
    assert [one.name for one in tree.loops] == ["j1"]
    assert [entry.link.name for entry in tree.links] == ["l1", "l2", "l3", "l4", "l0"]


def test_joint_of_a_link_that_is_missing_is_told() -> None:
    model = Model("m", links=(Link("arm"),), joints=(Joint("j", JointType.FIXED, "arm", "hnd"),))
    with pytest.raises(NotFoundError, match="joint 'j' names it as its child"):
        kinematic_tree(model)


@pytest.mark.parametrize(
    ("model", "text"),
    [
        (
            chain(501),
            "model 'm' has a chain of more than 500 moving joints, up to joint 'j501'\n"
            "  fix: if the file means it, set the environment variable GAZELLE_LIMITS=10",
        ),
        (
            chain(1001, JointType.FIXED),
            "model 'm' has a chain of more than 1000 links, up to joint 'j1000'; MuJoCo builds",
        ),
    ],
)
def test_chain_that_would_take_hours_is_refused_at_once(model: Model, text: str) -> None:
    with pytest.raises(LimitError) as caught:
        Engine(World(models=(model,)))
    assert str(caught.value).startswith(text)


def test_chain_is_as_long_as_the_user_says(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GAZELLE_LIMITS", "1.2")
    assert len(kinematic_tree(chain(501)).links) == 502


def test_deep_tree_that_never_moves_is_no_chain() -> None:
    kinematic_tree(chain(501, static=True))
