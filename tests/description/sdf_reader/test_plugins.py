from __future__ import annotations

from gazelle.description.sdf_reader.plugins import read_plugin, read_plugins


def test_parameters_stay_xml(tag):
    found = read_plugin(
        tag("<plugin name='drive' filename='libd.so'><leftJoint>l</leftJoint></plugin>"),
        reference="base",
    )
    assert (found.name, found.filename, found.reference) == ("drive", "libd.so", "base")
    assert found.parameters.text_of("leftJoint") == "l"
    assert found.span.line == 1


def test_several_plugins_keep_their_order(tag):
    found = read_plugins(tag("<model><plugin name='b'/><plugin name='a'/></model>"))
    assert [(item.name, item.filename) for item in found] == [("b", ""), ("a", "")]
