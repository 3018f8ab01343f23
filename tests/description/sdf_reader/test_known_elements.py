from __future__ import annotations

import pytest

from gazelle.description.sdf_reader.known_elements import ELEMENTS, check_elements
from gazelle.diagnostics import Severity


def test_mistyped_element_names_the_nearest(model, diagnostics):
    model("<link name='l'><colision name='c'/></link>")
    (found,) = diagnostics.by_code("xml.unknown-tag")
    assert found.message == "<colision> is not known inside <link>; it has no effect"
    assert found.fix == "did you mean 'collision'?"


def test_mistyped_attribute_names_the_nearest(model, diagnostics):
    model("<link name='l'><pose relativ_to='x'>0 0 0 0 0 0</pose></link>")
    (found,) = diagnostics.by_code("xml.unknown-attribute")
    assert "'relativ_to' is not known on <pose>" in found.message
    assert found.fix == "did you mean 'relative_to'?"


def test_equal_mistakes_are_told_once_with_their_number(model, diagnostics):
    model("".join(f"<link name='l{n}'><colour/></link>" for n in range(5)))
    (found,) = diagnostics.by_code("xml.unknown-tag")
    assert found.message.endswith("(and 4 more in this file)")


def test_same_word_elsewhere_is_another_finding(model, diagnostics):
    model("<link name='l'><mu/><sensor name='s' type='imu'><mu/></sensor></link>")
    assert len(diagnostics.by_code("xml.unknown-tag")) == 2


def test_word_in_the_wrong_place_is_unknown(model, diagnostics):
    model(
        "<link name='l'><collision name='c'><geometry><box/></geometry><mu>1</mu></collision>"
        "</link>"
    )
    assert (
        "<mu> is not known inside <collision>" in diagnostics.by_code("xml.unknown-tag")[0].message
    )


def test_legal_words_without_effect_are_told_of(model, diagnostics):
    model("<link name='l'><battery name='b'><voltage>12</voltage></battery></link>")
    (found,) = diagnostics.by_code("sdf.not-simulated")
    assert found.severity is Severity.INFO
    assert "<battery> in <link>" in found.message


def test_prefixed_elements_and_attributes_are_extensions(model, diagnostics):
    model("<gz:thing/><link name='l' gz:implicit='1'/>")
    messages = [item.message for item in diagnostics.by_code("sdf.extension")]
    assert any("'gz:thing' in <model>" in text for text in messages)
    assert any("'gz:implicit' in <link>" in text for text in messages)


def test_parameters_of_plugins_are_free(model, diagnostics):
    model(
        "<link name='l'/><plugin name='p' filename='f'><anything><at>all</at></anything></plugin>"
    )
    assert not len(diagnostics)


def test_namespace_declarations_are_legal(context, tag, diagnostics):
    check_elements(tag("<sdf version='1.9' xmlns:gz='http://gazebosim.org/schema'/>"), context)
    assert not len(diagnostics)


@pytest.mark.parametrize("kind", sorted(ELEMENTS))
def test_every_row_of_the_table_leads_to_rows(kind):
    element = ELEMENTS[kind]
    assert all(child in ELEMENTS for child in element.children.values())
    assert not element.without_effect & set(element.children)
