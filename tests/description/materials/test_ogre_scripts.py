from __future__ import annotations

import pytest

from gazelle.description.materials.ogre_scripts import parse_material_script
from gazelle.diagnostics import Diagnostics

SCRIPT = """
// a comment
vertex_program Some/Program glsl
{
  source a.vert
}
material First : Base
{
  receive_shadows off
  technique
  {
    pass one { ambient .1 .2 .3
      diffuse 0.4 0.5 0.6 0.7
      specular 1 1 1 1 12.5
    }
    pass two
    {
      diffuse 9 9 9   /* the first word counts,
                         not this one */
      emissive 0.1 0 0
      lighting off
      texture_unit
      {
        texture "my picture.png"
        scale 0.5 0.25
      }
      texture_unit { texture second.png }
    }
  }
  technique { pass { ambient 1 1 1 } }
}
material Base { technique { pass { specular 0 0 0 } } }
"""


@pytest.fixture
def diagnostics():
    return Diagnostics()


def test_words_of_a_script(diagnostics):
    found = parse_material_script(SCRIPT, "a.material", diagnostics)
    assert sorted(found) == ["Base", "First"]
    first = found["First"]
    assert first.base == "Base"
    assert first.colours == {
        "ambient": (0.1, 0.2, 0.3),
        "diffuse": (0.4, 0.5, 0.6, 0.7),
        "specular": (1, 1, 1, 1, 12.5),
        "emissive": (0.1, 0, 0),
    }
    assert (first.texture, first.scale, first.lighting) == ("my picture.png", (0.5, 0.25), False)
    assert not len(diagnostics)


def test_places_survive_comments(diagnostics):
    assert parse_material_script(SCRIPT, "a.material", diagnostics)["Base"].span.line == 32


def test_colours_of_vertices_are_left_alone(diagnostics):
    text = "material M\n{\ntechnique\n{\npass\n{\ndiffuse vertexcolour\n}\n}\n}"
    assert parse_material_script(text, "a", diagnostics)["M"].colours == {}


def test_missing_brace_is_reported(diagnostics):
    parse_material_script("material M\n{\ntechnique\n{\n", "a.material", diagnostics)
    assert "ends inside 'technique'" in diagnostics.by_code("material.bad-script")[0].message


def test_extra_brace_is_reported_with_its_line(diagnostics):
    parse_material_script("\n}\n", "a.material", diagnostics)
    (found,) = diagnostics.by_code("material.bad-script")
    assert str(found.span) == "a.material:2"


def test_bad_number_is_reported_with_its_line(diagnostics):
    text = "material M\n{\ntechnique\n{\npass\n{\ndiffuse 1 x 0\n}\n}\n}"
    assert parse_material_script(text, "a.material", diagnostics)["M"].colours["diffuse"] == ()
    (found,) = diagnostics.by_code("material.bad-script")
    assert "'diffuse 1 x 0'" in found.message
    assert found.span.line == 7
