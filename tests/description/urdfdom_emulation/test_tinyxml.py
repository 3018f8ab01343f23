"""TinyXML's reading of good and bad texts."""

from __future__ import annotations

import pytest

from gazelle.description.urdfdom_emulation.tinyxml import TinyXmlError, parse_tinyxml


def test_elements_keep_order_and_attributes() -> None:
    (robot,) = parse_tinyxml(
        "<?xml version='1.0'?>\n<r a='1'><b/><c x=\"&lt;&#x41;&#66;\"/><b/></r>\n"
    )
    assert (robot.name, robot.attributes) == ("r", {"a": "1"})
    assert [child.name for child in robot.children] == ["b", "c", "b"]
    found = robot.first("c")
    assert found is not None
    assert found.attributes == {"x": "<AB"}
    assert len(robot.all("b")) == 2
    assert robot.first("d") is None


def test_what_xml_forbids_and_tinyxml_takes() -> None:
    text = (
        "<!DOCTYPE r><r a=1 b='x\ny' c='a&b'><!-- -- --><![CDATA[<no>]]>"
        "<1>text &amp; more<e/></r> garbage"
    )
    (root,) = parse_tinyxml(text)
    assert root.attributes == {"a": "1", "b": "x\ny", "c": "ab"}
    assert [child.name for child in root.children] == ["e"]
    assert [item.name for item in parse_tinyxml("\ufeff<a/><b/>\n")] == ["a", "b"]


def test_a_doctype_with_entities_hides_the_rest() -> None:
    assert parse_tinyxml("<!DOCTYPE r [<!ENTITY a 'b'> ]>\n<r/>\n") == []


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "Error document empty."),
        ("\n", "Error document empty."),
        ("text <a/>\n", "Error document empty."),
        ("<a", "Failed to read Element name"),
        ("<a /b>\n", "Error: empty tag."),
        ("<a b>\n", "Error reading Attributes."),
        ("<a b=\n", "Error reading Attributes."),
        ("<a b=c'd/>\n", "Error reading Attributes."),
        ("<a b='c>\n", "Error parsing Element."),
        ("<a b='1' b='2'/>\n", "Error parsing Element."),
        ("<a b='&#zz;'/>\n", "Error parsing Element."),
        ("<a>\n", "Error reading end tag."),
        ("<a>", "Error reading Element value."),
        ("<a><!-- \n", "Error reading Element value."),
        ("<a><![CDATA[ \n", "Error reading Element value."),
        ("<a><?xml \n", "Error reading Element value."),
        ("<a>&#zz;</a>\n", "Error reading Element value."),
        ("<a>text\n", "Error reading Element value."),
        ("<a></b>\n", "Error reading end tag."),
        ("<a></ab>\n", "Error reading end tag."),
    ],
)
def test_mistakes_have_the_words_of_tinyxml(text: str, message: str) -> None:
    with pytest.raises(TinyXmlError) as caught:
        parse_tinyxml(text)
    assert str(caught.value) == message


def test_deep_nesting_is_no_recursion() -> None:
    (root,) = parse_tinyxml("<a>" * 50_000 + "</a>" * 50_000 + "\n")
    depth = 0
    while root.children:
        (root,) = root.children
        depth += 1
    assert depth == 49_999


def test_a_nul_ends_the_text() -> None:
    assert len(parse_tinyxml("<a/>\0<b/>")) == 1
