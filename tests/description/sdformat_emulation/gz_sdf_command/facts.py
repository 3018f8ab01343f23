"""Facts of an installed sdformat's specification in Gazelle's form, to compare ours with.

``specification.txt`` was written with this: ``python facts.py SPEC_1_7_DIR SPEC_1_9_DIR``, and
``upgrades.txt`` with ``python facts.py DIR`` where DIR holds a folder for every version.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics

__all__ = ["definitions_in", "upgrade_rules"]

_MARKS = {"0": "?", "1": "!", "-1": "-"}
_UNUSED = {"urdf", "gazebo"}


def definitions_in(folder: Path) -> dict[str, list[str]]:
    """Return the lines of every file of a version's folder, by the file's name."""
    files = (file for file in sorted(folder.glob("*.sdf")) if file.stem not in _UNUSED)
    return {file.stem: list(_element(_root(file), "")) for file in files}


def upgrade_rules(folder: Path) -> Iterator[str]:
    """Yield the lines of every conversion below a folder of versions."""
    for file in sorted(folder.glob("*/*.convert")):
        yield f"== {file.stem.replace('_', '.')} {file.parent.name}"
        yield from _conversion(_root(file), "")


def _root(file: Path) -> Tag:
    root = read_xml(file, Diagnostics())
    assert root is not None, file
    return root


def _element(tag: Tag, indent: str) -> Iterator[str]:
    mark = tag.attributes["required"].strip()
    yield f"{indent}{tag.attributes['name']} {_MARKS.get(mark, mark)}{_value(tag)}"
    inner = indent + " "
    for attribute in tag.find_all("attribute"):
        mark = "!" if attribute.attributes["required"].strip() == "1" else "?"
        yield f"{inner}@{attribute.attributes['name']} {mark}{_value(attribute)}"
    if "ref" in tag.attributes:
        yield f"{inner}^{tag.attributes['ref']}"
    for child in tag.find_all("element"):
        if child.attributes.get("copy_data") in ("true", "1"):
            yield f"{inner}..."
        else:
            yield from _element(child, inner)
    for include in tag.find_all("include"):
        yield f"{inner}<{Path(include.attributes['filename']).stem}"


def _value(tag: Tag) -> str:
    if "type" not in tag.attributes:
        return ""
    limits = ",".join(tag.attributes.get(key, "") for key in ("min", "max"))
    # Limits of attributes are not read by sdformat.
    limits = f"[{limits}]" if limits != "," and tag.name == "element" else ""
    kind = tag.attributes["type"].replace(" ", "_")
    return f" {kind}{limits}={tag.attributes.get('default', '')}"


def _conversion(tag: Tag, indent: str) -> Iterator[str]:
    for child in tag.children:
        if child.name == "convert":
            inner = list(_conversion(child, indent + " "))
            if inner:
                descendant = child.attributes.get("descendant_name")
                yield indent + (f"//{descendant}" if descendant else child.attributes["name"])
                yield from inner
        elif child.name != "rename" or child.find("from") is not None:
            yield f"{indent}:{child.name} {_action(child)}".rstrip()


def _action(tag: Tag) -> str:
    ends = [tag.find("from"), tag.find("to")]
    if ends[0] is None or ends[1] is None:
        words = (tag.attributes.get("element"), tag.attributes.get("attribute"))
        name = words[0] or (f"@{words[1]}" if words[1] else tag.text)
        return f"{name} {tag.attributes.get('value', '')}".strip()
    if tag.name == "map":
        values = [[value.text for value in end.find_all("value")] for end in ends if end]
        names = [end.attributes["name"] for end in ends if end]
        return " ".join(
            f"{name} {','.join(words)}" for name, words in zip(names, values, strict=True)
        )
    return " ".join(_place(end) for end in ends if end)


def _place(end: Tag) -> str:
    path = end.attributes.get("element", "").replace("::", "/")
    attribute = end.attributes.get("attribute")
    return f"{path}@{attribute}" if attribute else path


def _written(folders: dict[str, Path]) -> Iterator[str]:
    versions = {version: definitions_in(folder) for version, folder in folders.items()}
    old, new = versions.values()
    for name in sorted(old.keys() | new.keys()):
        if old.get(name) == new.get(name):
            yield "\n".join([f"== {name}", *old[name]])
            continue
        for version, definitions in versions.items():
            if name in definitions:
                yield "\n".join([f"== {name} {version}", *definitions[name]])


if __name__ == "__main__":
    if len(sys.argv) == 2:
        print("\n".join(upgrade_rules(Path(sys.argv[1]))))
    else:
        print("\n".join(_written({"1.7": Path(sys.argv[1]), "1.9": Path(sys.argv[2])})))
