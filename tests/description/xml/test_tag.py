from __future__ import annotations

import pytest

from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import Diagnostics

TEXT = """<model name="m">
  <link name="a"><pose>1 2 3</pose><empty/></link>
  <link name="b &amp; &lt;c&gt;"/>
</model>"""


@pytest.fixture
def model() -> Tag:
    return parse_xml(TEXT, "m.sdf", Diagnostics())


def test_descendants_are_found_by_path(model):
    assert model.find("link", "pose").text == "1 2 3"
    assert model.find("link", "nothing") is None
    assert model.find("nothing", "pose") is None
    assert model.find() is model


def test_children_of_one_name_come_in_order(model):
    assert [link.attributes["name"] for link in model.find_all("link")] == ["a", "b & <c>"]


def test_text_has_a_default_where_it_is_absent_or_empty(model):
    assert model.text_of("link", "pose") == "1 2 3"
    assert model.text_of("link", "empty", default="x") == "x"
    assert model.text_of("joint", default="y") == "y"


def test_walking_is_in_document_order(model):
    assert [tag.name for tag in model.walk()] == ["model", "link", "pose", "empty", "link"]


def test_xml_goes_round(model):
    again = parse_xml(model.to_xml(), "m.sdf", Diagnostics())

    def plain(tag: Tag):
        return (tag.name, tag.attributes, tag.text, [plain(child) for child in tag.children])

    assert plain(again) == plain(model)


def test_tags_cannot_be_changed(model):
    with pytest.raises(AttributeError):
        model.name = "other"
