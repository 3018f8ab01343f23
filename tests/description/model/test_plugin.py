from __future__ import annotations

from gazelle.description.model.plugin import read_plugin, read_plugins
from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import Diagnostics


def _tag(text: str) -> Tag:
    found = parse_xml(text, "test.sdf", Diagnostics())
    assert found is not None
    return found


def test_parameters_stay_xml() -> None:
    found = read_plugin(
        _tag("<plugin name='drive' filename='libd.so'><leftJoint>l</leftJoint></plugin>"),
        reference="base",
    )
    assert (found.name, found.filename, found.reference) == ("drive", "libd.so", "base")
    assert found.parameters.text_of("leftJoint") == "l"
    assert found.span is not None
    assert found.span.line == 1


def test_several_plugins_keep_their_order() -> None:
    found = read_plugins(_tag("<model><plugin name='b'/><plugin name='a'/></model>"))
    assert [(item.name, item.filename) for item in found] == [("b", ""), ("a", "")]
