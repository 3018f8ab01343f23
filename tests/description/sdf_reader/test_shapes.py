from __future__ import annotations

import pytest

from gazelle.description.model import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Plane,
    Polyline,
    Sphere,
)
from gazelle.description.sdf_reader.shapes import read_shape


@pytest.fixture
def shape(tag, context):
    def read(text):
        owner = tag(f"<visual name='v'><geometry>{text}</geometry></visual>")
        return read_shape(owner.find("geometry"), context, owner=owner)

    return read


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<box><size>1 2 3</size></box>", Box((1, 2, 3))),
        ("<sphere><radius>2</radius></sphere>", Sphere(2)),
        ("<cylinder><radius>.1</radius><length>.2</length></cylinder>", Cylinder(0.1, 0.2)),
        ("<capsule><radius>.1</radius><length>.2</length></capsule>", Capsule(0.1, 0.2)),
        ("<cone><radius>.1</radius><length>.2</length></cone>", Cone(0.1, 0.2)),
        ("<ellipsoid><radii>1 2 3</radii></ellipsoid>", Ellipsoid((1, 2, 3))),
        ("<plane><normal>1 0 0</normal><size>3 4</size></plane>", Plane((1, 0, 0), (3, 4))),
        ("<plane/>", Plane()),
        ("<capsule/>", Capsule(0.5, 1)),
    ],
)
def test_plain_shapes(shape, text, expected, diagnostics):
    assert shape(text) == expected
    assert not len(diagnostics)


def test_every_polyline_is_an_outline(shape):
    outer = (
        "<polyline><point>0 0</point><point>4 0</point><point>0 4</point><height>2</height>"
        "</polyline>"
    )
    inner = "<polyline><point>1 1</point><point>2 1</point><point>1 2</point></polyline>"
    found = shape(outer + inner)
    assert isinstance(found, Polyline)
    assert found.height_m == 2
    assert found.outlines_m[1] == ((1, 1), (2, 1), (1, 2))


def test_short_polyline_is_reported(shape, diagnostics):
    assert shape("<polyline><point>0 0</point></polyline>") is None
    assert "fewer than 3 points" in diagnostics.by_code("sdf.bad-geometry")[0].message


def test_mesh_beside_the_file_is_found(shape, tmp_path):
    (tmp_path / "a.stl").write_text("solid a\nendsolid a\n")
    found = shape(
        "<mesh><uri>a.stl</uri><scale>.1 .1 .1</scale><submesh><name>s</name><center>1</center>"
        "</submesh></mesh>"
    )
    assert found.path == tmp_path / "a.stl"
    assert (found.scale, found.submesh, found.center_submesh) == ((0.1, 0.1, 0.1), "s", True)


def test_missing_mesh_keeps_the_shape_and_says_where_it_looked(shape, diagnostics, tmp_path):
    found = shape("<mesh><uri>file://meshes/no.dae</uri></mesh>")
    assert found.path is None
    (warning,) = diagnostics.by_code("sdf.missing-file")
    assert "meshes/no.dae" in warning.message
    assert str(tmp_path) in warning.message
    assert not diagnostics.errors


def test_missing_mesh_is_reported_once_per_address(shape, diagnostics):
    for _ in range(3):
        shape("<mesh><uri>no.dae</uri></mesh>")
    assert len(diagnostics.by_code("sdf.missing-file")) == 1


def test_mesh_without_address_is_reported(shape, diagnostics):
    assert shape("<mesh/>").path is None
    assert "names no file" in diagnostics.by_code("sdf.missing-file")[0].message


def test_heightmap_words(shape, tmp_path):
    (tmp_path / "h.png").write_bytes(b"")
    found = shape("<heightmap><uri>h.png</uri><size>9 9 2</size><pos>0 0 1</pos></heightmap>")
    assert (found.size_m, found.position_m, found.path) == (
        (9, 9, 2),
        (0, 0, 1),
        tmp_path / "h.png",
    )


def test_empty_geometry_is_legal(shape, diagnostics):
    assert shape("<empty/>") is None
    assert not len(diagnostics)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "without a shape"),
        ("<image/>", "extruded <image>"),
        ("<sphere><radius>-2</radius></sphere>", "<radius> is not positive (-2)"),
        ("<box><size>1 -1 1</size></box>", "<size> is not positive (-1)"),
        ("<ellipsoid><radii>1 0 -1</radii></ellipsoid>", "<radii> is not positive"),
        ("<cylinder><radius>1</radius><length>-2</length></cylinder>", "<length> is not positive"),
    ],
)
def test_unusable_geometry_is_reported(shape, diagnostics, text, words):
    assert shape(text) is None
    (found,) = diagnostics.by_code("sdf.bad-geometry")
    assert "visual 'v'" in found.message
    assert words in found.message


@pytest.mark.parametrize(
    ("text", "used", "words"),
    [
        ("<box><size>5 5 0</size></box>", Box((5.0, 5.0, 1e-4)), "<box> whose <size> is 0"),
        ("<sphere><radius>0</radius></sphere>", Sphere(1e-4), "<sphere> whose <radius> is 0"),
        (
            "<cylinder><radius>1</radius><length>0</length></cylinder>",
            Cylinder(1.0, 1e-4),
            "<cylinder> whose <length> is 0",
        ),
    ],
)
def test_a_length_of_0_is_as_thin_as_in_gazebo(shape, diagnostics, text, used, words):
    assert shape(text) == used
    (found,) = diagnostics.by_code("sdf.bad-geometry")
    assert found.message == f"visual 'v' has a {words}; 0.0001 m is used, as in Gazebo"


def test_missing_geometry_is_reported(tag, context, diagnostics):
    assert read_shape(None, context, owner=tag("<collision name='c'/>")) is None
    assert "collision 'c' has no <geometry>" in diagnostics.by_code("sdf.bad-geometry")[0].message


def test_null_normal_is_reported(shape, diagnostics):
    assert shape("<plane><normal>0 0 0</normal></plane>") == Plane()
    assert "length 0" in diagnostics.by_code("sdf.bad-value")[0].message


def test_single_scale_counts_for_all_axes(model, diagnostics, tmp_path):
    (tmp_path / "a.stl").touch()
    body = (
        "<link name='l'><visual name='v'><geometry><mesh><uri>a.stl</uri><scale>0.001</scale>"
        "</mesh></geometry></visual></link>"
    )
    (visual,) = model(body).link("l").visuals
    assert visual.shape.scale == (0.001, 0.001, 0.001)
    (finding,) = diagnostics
    assert finding.message == "<scale> needs 3 numbers, found 1: 0.001 is used for all axes"
