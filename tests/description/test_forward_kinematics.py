"""Forward kinematics against poses worked out on paper."""

from __future__ import annotations

import math

import pytest

from gazelle.description.forward_kinematics import movable_joints, posed_model
from gazelle.description.loader import load_models
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics
from gazelle.errors import NotFoundError

ARM = """<robot name="arm">
  <link name="base"/><link name="upper"/><link name="lower"/><link name="finger"/><link name="tip"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="lower"/><child link="finger"/><origin xyz="1 0 0"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/><mimic joint="elbow" multiplier="0.5"/>
  </joint>
  <joint name="weld" type="fixed">
    <parent link="finger"/><child link="tip"/><origin xyz="0.1 0 0"/>
  </joint>
</robot>"""


@pytest.fixture
def arm() -> Model:
    (model,) = load_models(ARM, workspace=None, diagnostics=Diagnostics())
    return model


def _place(model: Model, name: str) -> tuple[float, float, float]:
    link = model.link(name)
    assert link is not None
    return link.T_model_link.position_m


def test_at_zero_nothing_moves(arm: Model) -> None:
    assert posed_model(arm) == arm


def test_turned_joints_carry_everything_below_them(arm: Model) -> None:
    posed = posed_model(arm, {"shoulder": math.pi / 2, "elbow": math.pi / 2, "slide": 0.25})
    assert _place(posed, "base") == (0.0, 0.0, 0.0)
    assert _place(posed, "lower") == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    # Down the upper arm's x is -z; the elbow turns the lower arm's x to +y.
    assert _place(posed, "finger") == pytest.approx((0.0, 1.25, 0.0), abs=1e-12)
    assert _place(posed, "tip") == pytest.approx((0.0, 1.35, 0.0), abs=1e-12)


def test_mimicking_joint_follows_its_leader(arm: Model) -> None:
    posed = posed_model(arm, {"elbow": 0.4})
    reach = 1.0 + 0.5 * 0.4
    expected = (1 + reach * math.cos(0.4), reach * math.sin(0.4), 1.0)
    assert _place(posed, "finger") == pytest.approx(expected, abs=1e-12)


def test_joint_frames_move_with_their_links(arm: Model) -> None:
    posed = posed_model(arm, {"shoulder": 0.7, "elbow": -0.3})
    for joint in posed.joints:
        assert joint.T_model_joint.position_m == pytest.approx(_place(posed, joint.child))


def test_unknown_joint_is_refused_with_the_nearest(arm: Model) -> None:
    assert movable_joints(arm) == ("shoulder", "elbow", "slide")
    with pytest.raises(NotFoundError, match="movable joint 'sholder' not found; did you mean 'sh"):
        posed_model(arm, {"sholder": 1.0})
    with pytest.raises(NotFoundError, match="joints of 'arm' that move: shoulder, elbow, slide"):
        posed_model(arm, {"weld": 1.0})
