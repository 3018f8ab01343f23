from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.diagnostics import Severity

BOX = "<collision name='c'>{extra}<geometry><box><size>1 2 3</size></box></geometry></collision>"


def _inertial(model, body, **words):
    return model(f"<link name='base'>{body}</link>", **words).link("base").inertial


def test_default_is_one_kilogram_with_unit_moments(model):
    found = _inertial(model, "")
    assert (found.mass_kg, found.inertia_kg_m2) == (1.0, (1, 0, 0, 1, 0, 1))


def test_mass_without_tensor_keeps_unit_moments(model):
    found = _inertial(model, "<inertial><mass>3</mass></inertial>")
    assert (found.mass_kg, found.inertia_kg_m2) == (3.0, (1, 0, 0, 1, 0, 1))


def test_pose_mass_and_tensor(model):
    found = _inertial(
        model,
        "<inertial><pose>1 0 0 0 0 0</pose><mass>2</mass><inertia><ixx>.2</ixx><ixy>.01</ixy>"
        "<ixz>.02</ixz><iyy>.3</iyy><iyz>.03</iyz><izz>.4</izz></inertia></inertial>",
    )
    assert found.T_link_com.position_m == (1, 0, 0)
    assert found.inertia_kg_m2 == (0.2, 0.01, 0.02, 0.3, 0.03, 0.4)


def test_density_times_volume_makes_the_mass(model):
    found = _inertial(
        model, "<inertial auto='true'><density>10</density></inertial>" + BOX.format(extra="")
    )
    assert found.estimated
    assert found.mass_kg == pytest.approx(60)
    assert found.inertia_kg_m2 == pytest.approx((65, 0, 0, 50, 0, 25))


def test_collisions_density_goes_before_the_links(model):
    box = BOX.format(extra="<density>2</density>")
    assert _inertial(model, "<inertial auto='true'/>" + box).mass_kg == pytest.approx(12)


def test_water_is_the_usual_density(model):
    found = _inertial(model, "<inertial auto='true'/>" + BOX.format(extra=""))
    assert found.mass_kg == pytest.approx(6000)


def test_mass_beside_auto_scales_the_tensor(model):
    found = _inertial(
        model, "<inertial auto='true'><mass>6</mass></inertial>" + BOX.format(extra="")
    )
    assert found.inertia_kg_m2 == pytest.approx((6.5, 0, 0, 5, 0, 2.5))


def test_two_halves_weigh_as_much_as_the_whole(model):
    """Law: a box cut in two has the same mass properties."""
    half = (
        "<collision name='{}'><pose>{} 0 0 0 0 0</pose><geometry><box><size>0.5 2 3</size></box>"
        "</geometry></collision>"
    )
    cut = _inertial(
        model, "<inertial auto='1'/>" + half.format("a", 0.25) + half.format("b", -0.25)
    )
    whole = _inertial(model, "<inertial auto='1'/>" + BOX.format(extra=""))
    assert cut.mass_kg == pytest.approx(whole.mass_kg)
    assert cut.inertia_kg_m2 == pytest.approx(whole.inertia_kg_m2)


@pytest.mark.parametrize(
    ("shape", "volume"),
    [
        ("<sphere><radius>0.5</radius></sphere>", math.pi / 6),
        ("<cylinder><radius>1</radius><length>2</length></cylinder>", 2 * math.pi),
        ("<cone><radius>1</radius><length>3</length></cone>", math.pi),
        ("<capsule><radius>1</radius><length>2</length></capsule>", math.pi * (2 + 4 / 3)),
        ("<ellipsoid><radii>1 2 3</radii></ellipsoid>", 8 * math.pi),
        (
            "<polyline><point>0 0</point><point>1 0</point><point>1 1</point><point>0 1</point>"
            "<height>2</height></polyline>",
            2.0,
        ),
    ],
)
def test_volume_of_every_shape(model, shape, volume):
    collision = f"<collision name='c'><geometry>{shape}</geometry></collision>"
    body = f"<inertial auto='true'><density>1</density></inertial>{collision}"
    found = _inertial(model, body, version="1.11")
    assert found.mass_kg == pytest.approx(volume)
    a, b, c = np.sort(np.asarray(found.inertia_kg_m2)[[0, 3, 5]])
    assert 0 < c <= a + b


def test_nothing_to_compute_from_is_reported(model, diagnostics):
    found = _inertial(model, "<inertial auto='true'/>")
    assert found.mass_kg == 1.0
    assert "link 'base' has no collision" in diagnostics.by_code("sdf.auto-inertia")[0].message


def test_mass_of_zero_is_an_error_at_its_place(model, diagnostics):
    found = _inertial(model, "<inertial><mass>0</mass></inertial>")
    assert found.mass_kg == 1.0
    (error,) = diagnostics.errors
    assert "link 'base' has the mass 0 kg" in error.message
    assert error.phrase == "A link named ... has invalid inertia."


def test_tensor_of_zero_is_an_error(model, diagnostics):
    zero = "<inertia><ixx>0</ixx><iyy>0</iyy><izz>0</izz></inertia>"
    found = _inertial(model, f"<inertial><mass>1</mass>{zero}</inertial>")
    assert min(found.inertia_kg_m2[0], found.inertia_kg_m2[3], found.inertia_kg_m2[5]) > 0
    assert "not positive" in diagnostics.errors[0].message


def test_broken_triangle_inequality_is_a_warning(model, diagnostics):
    tensor = "<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>1</izz></inertia>"
    _inertial(model, f"<inertial><mass>1</mass>{tensor}</inertial>")
    (found,) = diagnostics.by_code("sdf.bad-inertia")
    assert found.severity is Severity.WARNING
    assert "triangle" in found.message


def test_static_models_may_weigh_nothing(model, diagnostics):
    body = "<static>1</static><link name='base'><inertial><mass>0</mass></inertial></link>"
    assert model(body).link("base").inertial.mass_kg == 0
    assert not len(diagnostics)


def test_density_of_zero_is_reported_and_waters_used(model, diagnostics):
    text = "<inertial auto='true'><density>0</density></inertial>" + BOX.format(extra="")
    assert _inertial(model, text).mass_kg == pytest.approx(6000)
    assert "<density> is 0" in diagnostics.by_code("sdf.bad-value")[0].message


@pytest.mark.parametrize("word", ["nan", "-nan", "inf"])
def test_infinite_tensor_becomes_the_default(model, diagnostics, word):
    found = _inertial(
        model,
        f"<inertial><mass>2</mass><inertia><ixx>{word}</ixx><iyy>0.1</iyy></inertia></inertial>",
    )
    assert (found.mass_kg, found.inertia_kg_m2) == (2.0, (1, 0, 0, 1, 0, 1))
    (finding,) = diagnostics
    assert (finding.code, finding.severity) == ("sdf.bad-inertia", Severity.WARNING)
    assert "link 'base' is not finite (ixx)" in finding.message


@pytest.mark.parametrize(("version", "severity"), [("1.6", "WARNING"), ("1.7", "ERROR")])
@pytest.mark.parametrize("body", ["<mass>-1</mass>", "<inertia><ixx>0</ixx></inertia>"])
def test_impossible_inertia_stops_only_what_gazebo_refuses(
    model, diagnostics, version, severity, body
):
    _inertial(model, f"<inertial>{body}</inertial>", version=version)
    (finding,) = diagnostics.by_code("sdf.bad-inertia")
    assert finding.severity is Severity[severity]
