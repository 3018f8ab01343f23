from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.shared_files import needs_shared

from gazelle.diagnostics import Diagnostics
from gazelle.geometry import MeshError, load_mesh, load_mesh_reported

DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>{asset}</asset>
  <library_images><image id="img"><init_from>{image}</init_from></image></library_images>
  <library_effects>
    <effect id="plain"><profile_COMMON><technique sid="c"><phong>
      <emission><color>0.1 0 0 1</color></emission>
      <ambient><color>0.2 0.2 0.2 1</color></ambient>
      <diffuse><color>1 0.5 0 1</color></diffuse>
      <specular><color>0.3 0.3 0.3 1</color></specular>
      <shininess><float>20</float></shininess>
      {transparency}
    </phong></technique></profile_COMMON></effect>
    <effect id="pictured"><profile_COMMON>
      <newparam sid="surf"><surface type="2D"><init_from>img</init_from></surface></newparam>
      <newparam sid="samp"><sampler2D><source>surf</source></sampler2D></newparam>
      <technique sid="c"><lambert>
        <diffuse><texture texture="samp" texcoord="UV"/></diffuse>
      </lambert></technique></profile_COMMON></effect>
  </library_effects>
  <library_materials>
    <material id="m1" name="orange"><instance_effect url="#plain"/></material>
    <material id="m2" name="photo"><instance_effect url="#pictured"/></material>
  </library_materials>
  <library_geometries><geometry id="geo" name="shape"><mesh>
    <source id="pos"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
      <technique_common><accessor source="#pa" count="4" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <source id="uv"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array>
      <technique_common><accessor source="#ua" count="4" stride="2">
        <param name="S" type="float"/><param name="T" type="float"/>
      </accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#pos"/></vertices>
    {primitives}
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="scene">{nodes}</visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"""
TRIANGLES = """<triangles material="A" count="2">
  <input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles>"""
POLYLIST = """<polylist material="B" count="1">
  <input semantic="VERTEX" source="#v" offset="0"/>
  <input semantic="TEXCOORD" source="#uv" offset="1"/>
  <vcount>4</vcount><p>0 0 1 1 2 2 3 3</p></polylist>"""
POLYGONS = """<polygons material="A" count="1">
  <input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 3</p></polygons>"""
LINES = """<lines material="A" count="1">
  <input semantic="VERTEX" source="#v" offset="0"/><p>0 1</p></lines>"""
INSTANCE = """<instance_geometry url="#geo"><bind_material><technique_common>
  <instance_material symbol="A" target="#m1"/><instance_material symbol="B" target="#m2"/>
</technique_common></bind_material></instance_geometry>"""
NODE = '<node id="n" name="plate">{}</node>'
PLATE = NODE.format(INSTANCE)
Z_UP = "<up_axis>Z_UP</up_axis>"


@pytest.fixture
def dae(write):
    def make(
        primitives=TRIANGLES,
        nodes=PLATE,
        asset=Z_UP,
        image="p.png",
        transparency="",
    ) -> Path:
        text = DAE.format(
            primitives=primitives, nodes=nodes, asset=asset, image=image, transparency=transparency
        )
        return write("meshes/a.dae", text)

    return make


def test_triangles_and_colours_are_read(dae, assert_well_formed):
    mesh = load_mesh(dae())
    (part,) = mesh.parts
    assert_well_formed(part)
    assert (part.name, len(part.vertices_m), len(part.faces), part.uv) == ("plate", 4, 2, None)
    assert mesh.notes == ()
    material = part.material
    assert (material.name, material.diffuse, material.texture) == ("orange", (1, 0.5, 0, 1), None)
    assert (material.ambient, material.emissive) == ((0.2, 0.2, 0.2, 1), (0.1, 0, 0, 1))
    assert (material.specular, material.shininess) == ((0.3, 0.3, 0.3, 1), 20)


@pytest.mark.parametrize("primitives", [TRIANGLES, POLYLIST, POLYGONS])
def test_every_kind_of_face_gives_the_same_square(dae, primitives, assert_well_formed):
    (part,) = load_mesh(dae(primitives)).parts
    assert_well_formed(part)
    assert sorted(part.vertices_m.tolist()) == [[0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0]]
    assert part.normals.tolist() == [[0, 0, 1]] * 4


def test_several_materials_make_several_parts(dae, write):
    picture = write("meshes/p.png", b"png")
    parts = load_mesh(dae(TRIANGLES + POLYLIST + LINES)).parts
    assert [part.material.name for part in parts] == ["orange", "photo"]
    assert parts[1].material.texture == picture
    assert parts[1].material.diffuse == (1, 1, 1, 1)
    # v counts upwards: the vertex at y = 1 has v = 1.
    np.testing.assert_array_equal(parts[1].uv, parts[1].vertices_m[:, :2])


@pytest.mark.parametrize("image", ["C:\\art\\p.png", "file:///home/artist/p.png", "../x/p.png"])
def test_an_artists_absolute_texture_path_is_found_beside_the_mesh(dae, write, image):
    picture = write("meshes/p.png", b"png")
    assert load_mesh(dae(POLYLIST, image=image)).parts[0].material.texture == picture


def test_textures_of_the_models_materials_folder_are_found(dae, write):
    picture = write("materials/textures/p.png", b"png")
    assert load_mesh(dae(POLYLIST)).parts[0].material.texture == picture


def test_a_missing_texture_is_told(dae):
    diagnostics = Diagnostics()
    mesh = load_mesh_reported(dae(POLYLIST), diagnostics)
    assert mesh.parts[0].material.texture is None
    (found,) = diagnostics.by_code("mesh.missing-texture")
    assert "texture 'p.png' not found" in found.message
    assert "materials/textures/p.png" in found.message


def test_the_unit_and_nested_nodes_are_applied(dae):
    inner = f'<node id="i" name="inner"><rotate>0 0 1 90</rotate>{INSTANCE}</node>'
    nodes = f'<node id="o"><translate>10 0 0</translate><scale>2 2 2</scale>{inner}</node>'
    mesh = load_mesh(dae(nodes=nodes, asset=f'<unit meter="0.01" name="cm"/>{Z_UP}'))
    assert mesh.submesh_names == ("inner",)
    np.testing.assert_allclose(mesh.bounds_m, [(0.08, 0, 0), (0.10, 0.02, 0)], atol=1e-9)


def test_a_geometry_used_twice_is_there_twice(dae):
    second = f'<node id="b" name="b"><translate>0 0 5</translate>{INSTANCE}</node>'
    mesh = load_mesh(dae(nodes=NODE.format(INSTANCE) + second))
    assert mesh.submesh_names == ("plate", "b")
    assert mesh.bounds_m[1][2] == 5


def test_up_axis_is_told_and_not_applied(dae):
    diagnostics = Diagnostics()
    mesh = load_mesh_reported(dae(asset="<up_axis>Y_UP</up_axis>"), diagnostics)
    assert mesh.bounds_m == ((0, 0, 0), (1, 1, 0))
    (found,) = diagnostics.by_code("mesh.up-axis")
    assert str(found.severity) == "info"
    assert "<up_axis> is Y_UP; it is not applied, as in Gazebo and RViz" in found.message


@pytest.mark.parametrize(
    ("transparency", "alpha"),
    [
        ("", 1.0),
        ("<transparency><float>0.25</float></transparency>", 0.25),
        ("<transparency><float>0</float></transparency>", 1.0),
        (
            '<transparent opaque="A_ONE"><color>0 0 0 0.5</color></transparent>'
            "<transparency><float>1</float></transparency>",
            0.5,
        ),
        (
            '<transparent opaque="RGB_ZERO"><color>0.25 0.25 0.25 1</color></transparent>'
            "<transparency><float>1</float></transparency>",
            0.75,
        ),
    ],
)
def test_transparency_follows_the_specification(dae, transparency, alpha):
    (part,) = load_mesh(dae(transparency=transparency)).parts
    assert part.material.diffuse[3] == pytest.approx(alpha, abs=1e-5)


def test_parts_that_cannot_be_used_are_told(dae):
    broken = NODE.format(INSTANCE) + NODE.format('<instance_geometry url="#gone"/>')
    diagnostics = Diagnostics()
    mesh = load_mesh_reported(dae(nodes=broken), diagnostics)
    assert len(mesh.parts) == 1
    (found,) = diagnostics.by_code("mesh.incomplete")
    assert "gone" in found.message


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("<COLLADA><unclosed></COLLADA>", "cannot be read as Collada"),
        ("<robot/>", "cannot be read as Collada"),
        ('<!DOCTYPE x [<!ENTITY e "f">]><COLLADA/>', "XML entities are refused"),
    ],
)
def test_a_broken_file_says_why(write, text, reason):
    with pytest.raises(MeshError, match=reason):
        load_mesh(write("b.dae", text))


def test_a_scene_without_triangles_says_so(dae):
    with pytest.raises(MeshError, match="the Collada scene has no triangles"):
        load_mesh(dae(LINES))


@needs_shared
@pytest.mark.reference
def test_sample_meshes_are_as_trimesh_reads_them(workspaces_dir: Path):
    trimesh = pytest.importorskip("trimesh")
    files = sorted(workspaces_dir.rglob("*.dae"))
    assert len(files) >= 6
    for path in files:
        ours, theirs = load_mesh(path), trimesh.load(path, force="mesh", process=False)
        assert len(ours.faces) == len(theirs.faces), path
        ours_size = np.sort(np.ptp(ours.bounds_m, axis=0))
        theirs_size = np.sort(theirs.extents * _metres(path))
        np.testing.assert_allclose(ours_size, theirs_size, rtol=1e-5)


def _metres(path: Path) -> float:
    """Trimesh keeps the file's unit."""
    import re

    found = re.search(r'meter="([^"]+)"', path.read_text(errors="replace"))
    return float(found.group(1)) if found else 1.0


@needs_shared
def test_turtlebots_walls_stand_upright(workspaces_dir: Path):
    """Its files say Y_UP and its world places them unrotated: Gazebo must not turn them."""
    (wall,) = workspaces_dir.rglob("wall.dae")
    low, high = load_mesh(wall).bounds_m
    assert low[2] == 0
    assert high[2] == pytest.approx(5.08)
    assert high[0] - low[0] > 20
