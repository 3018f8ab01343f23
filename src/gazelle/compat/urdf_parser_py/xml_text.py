"""XML elements and values as text: what `urdf_parser_py.xml_reflection.basics` has."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any
from xml.etree import ElementTree as ET
from xml.sax.saxutils import escape, quoteattr

from gazelle.documents.yaml import PYTHON_STYLE, dump_yaml

__all__ = [
    "SelectiveReflection",
    "YamlReflection",
    "dict_sub",
    "isstring",
    "node_add",
    "pfloat",
    "to_yaml",
    "xml_children",
    "xml_string",
]


def xml_string(rootXml: ET.Element, addHeader: bool = True) -> str:
    """Return an element's text, two spaces a level, with the XML declaration if wanted.

    Attributes keep their order. xml.dom.minidom would do, but xacro replaces its writer in the
    whole process by one that sorts them.
    """
    lines = ['<?xml version="1.0" ?>'] if addHeader else []
    return "\n".join([*lines, *_lines(rootXml, "")])


def _lines(element: ET.Element, indent: str) -> Iterator[str]:
    attributes = "".join(f" {name}={quoteattr(value)}" for name, value in element.items())
    text = escape((element.text or "").strip())
    start = f"{indent}<{element.tag}{attributes}"
    if not len(element):
        yield f"{start}>{text}</{element.tag}>" if text else f"{start}/>"
        return
    yield f"{start}>"
    if text:
        yield f"{indent}  {text}"
    for child in element:
        yield from _lines(child, f"{indent}  ")
    yield f"{indent}</{element.tag}>"


def dict_sub(obj: Mapping[Any, Any], keys: Iterable[Any]) -> dict[Any, Any]:
    """Return a dictionary of only these keys."""
    return {key: obj[key] for key in keys}


def node_add(doc: ET.Element, sub: ET.Element | str | None) -> ET.Element | None:
    """Append a child, given itself or as its tag, and return it."""
    if sub is None:
        return None
    if isinstance(sub, str):
        return ET.SubElement(doc, sub)
    if not isinstance(sub, ET.Element):
        raise Exception("Invalid sub value")
    doc.append(sub)
    return sub


def pfloat(x: object) -> str:
    """Return a number's text without a point at its end."""
    return str(x).rstrip(".")


def xml_children(node: ET.Element) -> list[ET.Element]:
    """Return an element's children; comments are none."""
    return [child for child in node if isinstance(child.tag, str)]


def isstring(obj: object) -> bool:
    """Tell whether something is text."""
    return isinstance(obj, str)


def to_yaml(obj: Any) -> Any:
    """Return something as YAML can write it: text, numbers, lists and dictionaries."""
    if isinstance(obj, (bool, int, float)):
        return obj
    if obj is None or isinstance(obj, str):
        return str(obj)
    if isinstance(obj, ET.Element):
        return xml_string(obj, addHeader=False)
    if hasattr(obj, "to_yaml"):
        return obj.to_yaml()
    if isinstance(obj, Mapping):
        return {str(key): to_yaml(value) for key, value in obj.items()}
    if hasattr(obj, "tolist"):
        return to_yaml(obj.tolist())
    return [to_yaml(item) for item in obj] if isinstance(obj, Iterable) else str(obj)


class SelectiveReflection:
    """Something whose variables can be listed."""

    def get_refl_vars(self) -> Sequence[str]:
        """Return the names of the variables that are written out."""
        return list(vars(self))


class YamlReflection(SelectiveReflection):
    """Something that prints itself as YAML."""

    def to_yaml(self) -> Any:
        """Return the variables as a dictionary."""
        return to_yaml({name: getattr(self, name) for name in self.get_refl_vars()})

    def __str__(self) -> str:
        return dump_yaml(self.to_yaml(), PYTHON_STYLE).rstrip()
