from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.description.materials import material_from_scripts
from gazelle.description.read_context import ReadContext
from gazelle.diagnostics import Diagnostics, Severity, SourceSpan

SCRIPT = """
material Box/Base { technique { pass { ambient 0.1 0.1 0.1
      specular 0.5 0.5 0.5 1 20
} } }
material Box/Side : Box/Base
{ technique { pass { diffuse 1 0 0
      texture_unit
      {
        texture side.png
        scale 0.5 0.25
      }
} } }
material Loop/A : Loop/B
{
}
material Loop/B : Loop/A
{
}
"""
SPAN = SourceSpan("a.sdf", 7, 3)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    scripts = tmp_path / "materials" / "scripts"
    scripts.mkdir(parents=True)
    (scripts / "box.material").write_text(SCRIPT, encoding="utf-8")
    (tmp_path / "materials" / "textures").mkdir()
    (tmp_path / "materials" / "textures" / "side.png").write_bytes(b"")
    return tmp_path


@pytest.fixture
def diagnostics() -> Diagnostics:
    return Diagnostics()


@pytest.fixture
def context(folder: Path, diagnostics: Diagnostics) -> ReadContext:
    return ReadContext(None, diagnostics, "a.sdf", folder)


@pytest.mark.parametrize(
    "uris",
    [
        ["materials/scripts"],
        ["materials/scripts/box.material"],
        ["file://materials/scripts", "file://materials/textures"],
    ],
)
def test_script_colours_base_and_picture(context, folder, diagnostics, uris):
    found = material_from_scripts(" Box/Side ", uris, context)
    assert (found.name, found.ambient, found.diffuse) == (
        "Box/Side",
        (0.1, 0.1, 0.1, 1),
        (1, 0, 0, 1),
    )
    assert (found.specular, found.shininess) == ((0.5, 0.5, 0.5, 1), 20)
    assert found.texture == folder / "materials" / "textures" / "side.png"
    # OGRE's scale makes the picture larger, so it repeats less often.
    assert found.texture_scale == (2, 4)
    assert not len(diagnostics)


def test_silence_in_a_script_is_ogres_white(context):
    assert material_from_scripts("Box/Base", ["materials/scripts"], context).diffuse == (1, 1, 1, 1)


def test_circle_of_bases_ends(context):
    assert material_from_scripts("Loop/A", ["materials/scripts"], context).name == "Loop/A"


def test_missing_picture_keeps_the_colours(context, folder, diagnostics):
    (folder / "materials" / "textures" / "side.png").unlink()
    found = material_from_scripts("Box/Side", ["materials/scripts"], context)
    assert (found.texture, found.diffuse) == (None, (1, 0, 0, 1))
    (warning,) = diagnostics.by_code("material.texture-missing")
    assert "picture 'side.png' of 'Box/Side' not found" in warning.message
    assert str(folder / "materials" / "textures") in warning.message
    assert warning.span.line == 5


def test_gazebos_own_script_needs_no_file(context, diagnostics):
    uri = "file://media/materials/scripts/gazebo.material"
    assert material_from_scripts("Gazebo/Red", [uri], context).diffuse == (1, 0, 0, 1)
    assert not len(diagnostics)


def test_picture_of_gazebos_own_is_told_of_once(context, diagnostics):
    for _ in range(3):
        material_from_scripts("Gazebo/Wood", [], context, span=SPAN)
    (note,) = diagnostics.by_code("material.plain-colour")
    assert (note.severity, note.span) == (Severity.INFO, SPAN)


def test_unknown_name_is_reported_with_the_nearest(context, diagnostics):
    assert material_from_scripts("Gazebo/Rde", [], context, span=SPAN) is None
    (warning,) = diagnostics.by_code("material.unknown")
    assert "material 'Gazebo/Rde' is not known" in warning.message
    assert "'Gazebo/Red'" in warning.fix
    assert warning.span == SPAN


def test_names_of_the_scripts_are_near_too(context, diagnostics):
    material_from_scripts("Box/Sid", ["materials/scripts"], context)
    assert "'Box/Side'" in diagnostics.by_code("material.unknown")[0].fix


def test_missing_script_is_reported_and_gazebos_list_tried(context, diagnostics):
    found = material_from_scripts("Gazebo/Blue", ["file://no/scripts"], context, span=SPAN)
    assert found.diffuse == (0, 0, 1, 1)
    (warning,) = diagnostics.by_code("material.script-missing")
    assert "no/scripts" in warning.message
