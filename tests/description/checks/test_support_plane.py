"""What a robot stands on."""

from __future__ import annotations

import pytest
from tests.description.checks.pain import FIXTURES, finding, place

from gazelle.description.checks.shape_volumes import Outlines
from gazelle.description.checks.support_plane import check_support_plane, support_plane_of
from gazelle.description.loader import load_models
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics, Severity


def _model(name: str) -> Model:
    (model,) = load_models(FIXTURES / name, workspace=None, diagnostics=Diagnostics())
    return model


def test_rover_rests_on_two_wheels_and_its_caster() -> None:
    model = _model("pain_15_contact/clean/rover.urdf")
    outlines = Outlines(model)
    plane = support_plane_of(model, outlines)
    assert plane is not None
    gaps = {
        item.link.name: gap for item, gap in zip(outlines.collisions, plane.gaps_m, strict=True)
    }
    assert gaps["left_wheel"] == pytest.approx(0.0, abs=1e-3)
    assert gaps["right_wheel"] == pytest.approx(0.0, abs=1e-3)
    assert gaps["caster"] == pytest.approx(0.0, abs=1e-3)
    # The chassis' underside is 4 cm above the ground.
    assert gaps["base_link"] == pytest.approx(0.04, abs=2e-3)
    assert plane.tilt_deg < 1.0


def test_model_without_mass_has_no_stance() -> None:
    assert support_plane_of(Model("ghost"), Outlines(Model("ghost"))) is None


def test_robot_that_stands_level_is_judged_without_a_hull(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_points: object) -> None:
        raise AssertionError("qhull takes long to import")

    model, found = _model("pain_15_contact/clean/rover.urdf"), Diagnostics()
    with monkeypatch.context() as patch:
        patch.setattr("gazelle.description.checks.support_plane.convex_hull", refuse)
        check_support_plane(model, Outlines(model), found)
    assert len(found) == 0


@pytest.mark.parametrize(
    "name", ["clean/rover", "broken/hanging", "broken/dragging_caster"]
)  # fmt: skip
def test_level_plane_leads_to_the_same_findings_as_the_hull(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    model = _model(f"pain_15_contact/{name}.urdf")
    quick, whole = Diagnostics(), Diagnostics()
    check_support_plane(model, Outlines(model), quick)
    monkeypatch.setattr(
        "gazelle.description.checks.support_plane._level_plane", lambda *_words: None
    )
    check_support_plane(model, Outlines(model), whole)
    assert tuple(quick) == tuple(whole)


def test_low_chassis_lifts_the_wheels() -> None:
    item = finding("pain_15_contact/hanging.urdf")
    assert item.code == "robot.wheel-in-the-air"
    assert "the robot rests on 'base_link'" in item.message
    assert "'left_wheel' (10 mm above) and 'right_wheel' (10 mm above) do not" in item.message
    assert place(item) == '<link name="left_wheel">'
    assert "wheels spin but robot does not move" in item.phrase


def test_sliding_caster_with_friction_is_a_notice() -> None:
    item = finding("pain_15_contact/dragging_caster.urdf")
    assert (item.code, item.severity) == ("robot.caster-friction", Severity.INFO)
    assert "'caster' slides on the ground and has Gazebo's friction of 1" in item.message
    assert item.fix == '<gazebo reference="caster"><mu1>0.01</mu1><mu2>0.01</mu2></gazebo>'
