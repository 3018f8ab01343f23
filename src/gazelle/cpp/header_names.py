"""What a header declares for its users: classes, functions and macros by name.

Read with as much C++ as that takes: comments, texts and bodies of functions are skipped, name
spaces are followed. Names of ours inside, such as ``detail``, are left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

__all__ = ["HeaderNames", "names_in"]

_SKIPPED = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+'""", re.DOTALL
)
_INCLUDE = re.compile(r"^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"\n]+)[>\"]", re.MULTILINE)
_PIECE = re.compile(r"^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"\n]+\.inc)[>\"]", re.MULTILINE)
_DEFINE = re.compile(r"^[ \t]*#[ \t]*define[ \t]+([A-Z][A-Z0-9_]*[A-Z0-9])\b", re.MULTILINE)
_DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.MULTILINE)
_ALIAS = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(GAZELLE_\w+)[ \t]+(\w+)[ \t]*$", re.MULTILINE)
_CLASS_MACRO = re.compile(r"#[ \t]*define[ \t]+(\w+)\(\w+[^()]*\)[ \t\\\n]*(?:class|struct)\b")
_ATTRIBUTE = re.compile(r"__attribute__\s*\(\((?:[^()]|\([^()]*\))*\)\)|\bGAZELLE_\w*EXPORT\b")
_CALL = re.compile(r"^(\w+)\s*\(\s*(\w+)")
_CONDITIONS = re.compile(r"^[ \t]*#[ \t]*(?:ifndef|undef)[ \t]+(\w+)", re.MULTILINE)
_TEMPLATE = re.compile(r"\btemplate\s*<")
_NAMESPACE = re.compile(r"\b(?:inline\s+)?namespace\s+([\w:]+)\s*$")
_CLASS = re.compile(r"^(?:class|struct)\s+(?:\[\[[^]]*\]\]\s*)?(?:[A-Z][A-Z_]*\s+)?(\w+)[^()=;]*$")
_ENUM = re.compile(r"^enum\s+(?:class\s+|struct\s+)?(\w+)")
_USING = re.compile(r"^using\s+(\w+)\s*=")
_TYPEDEF = re.compile(r"^typedef\s.*\b(\w+)\s*$", re.DOTALL)
_TYPES = (_CLASS, _ENUM, _USING, _TYPEDEF)
_FUNCTION = re.compile(r"([\w~]+)\s*\($")
_LEADING = re.compile(
    r"^(?:(?:public|private|protected)\s*:|GAZELLE_\w+(?:\([^()]*\))?|extern\s+\"\"|"
    r"\[\[[^]]*\]\])\s*"
)
_OURS = frozenset({"detail", "details", "impl", "internal", "gazelle", "std", "boost", "YAML"})
_NO_FUNCTIONS = frozenset(
    {"if", "for", "while", "switch", "return", "sizeof", "alignof", "decltype", "noexcept",
     "static_assert", "operator", "defined", "catch", "asm"}
)  # fmt: skip


class HeaderNames(NamedTuple):
    """The names of a header, each sorted and once.

    Attributes:
        classes: classes, enumerations and names for types, with their name spaces.
        functions: functions outside of classes, with their name spaces.
        macros: without those that guard a header or are ours.
        includes: headers that it includes.
    """

    classes: tuple[str, ...]
    functions: tuple[str, ...]
    macros: tuple[str, ...]
    includes: tuple[str, ...]


def names_in(header: Path) -> HeaderNames:
    """Return what a header declares."""
    text = header.read_text(encoding="utf-8")
    includes = tuple(dict.fromkeys(_INCLUDE.findall(text)))
    text = _PIECE.sub(lambda found: _piece(found[1]), text)
    for name, meant in _ALIAS.findall(text):
        text = re.sub(rf"(?<=namespace ){name}\b", meant, text)
    bare = _SKIPPED.sub(lambda found: '""' if found[0].startswith(('"', "R")) else " ", text)
    bare = _ATTRIBUTE.sub("", bare)
    tested = set(_CONDITIONS.findall(bare))
    macros = {
        name
        for name in _DEFINE.findall(bare)
        if not name.startswith("GAZELLE_") and not (name in tested and _is_guard(name, header))
    }
    classes: set[str] = set()
    functions: set[str] = set()
    makers = frozenset(_CLASS_MACRO.findall(bare))
    for space, statement, has_body in _statements(_DIRECTIVE.sub("", bare)):
        call = _CALL.match(statement)
        is_made = call is not None and call[1] in makers
        kind, name = (
            ("class", call[2]) if call and is_made else _declared(statement, has_body=has_body)
        )
        if name and not name.startswith(("_", "GAZELLE_")) and not _is_ours(space):
            full = "::".join([*space, name])
            (classes if kind == "class" else functions).add(full)
    return HeaderNames(
        tuple(sorted(classes)), tuple(sorted(functions)), tuple(sorted(macros)), includes
    )


def _piece(name: str) -> str:
    """Return the text of a part that several headers include in name spaces of their own."""
    file = Path(__file__).parent / "include" / "common" / name
    return file.read_text(encoding="utf-8") if file.is_file() else ""


def _is_guard(name: str, header: Path) -> bool:
    stem = re.sub(r"\W", "_", header.stem).upper()
    return stem in name and name.rstrip("_").endswith(("_H", "_HPP", stem))


def _is_ours(space: tuple[str, ...]) -> bool:
    return any(part in _OURS or part.startswith("_") for part in space)


def _statements(text: str) -> Iterator[tuple[tuple[str, ...], str, bool]]:
    """Yield what stands in name spaces, outside of bodies, and whether a body follows.

    The name spaces around it come first.
    """
    spaces: list[tuple[str, ...]] = [()]
    depth, start, index = 0, 0, 0
    while index < len(text):
        sign = text[index]
        if depth:
            depth += {"{": 1, "}": -1}.get(sign, 0)
            if depth == 0:
                start = index + 1
        elif sign == "{":
            head = text[start:index].strip()
            found = _NAMESPACE.search(head)
            if found or head in {"namespace", 'extern ""'}:
                is_inline = "inline" in head.split()
                added = tuple(found[1].split("::")) if found and not is_inline else ()
                hidden = ("_",) if head == "namespace" else ()
                spaces.append((*spaces[-1], *added, *hidden))
                start = index + 1
            else:
                yield spaces[-1], head, True
                depth = 1
        elif sign == "}":
            if len(spaces) > 1:
                spaces.pop()
            start = index + 1
        elif sign == ";":
            yield spaces[-1], text[start:index].strip(), False
            start = index + 1
        index += 1


def _declared(statement: str, *, has_body: bool) -> tuple[str, str]:
    """Return the kind and name of what a statement declares; an empty name for nothing."""
    text = _without_template(statement)
    while (rest := _LEADING.sub("", text)) != text:
        text = rest
    head = text.partition("(")[0]
    words = head.split()
    if not words or words[0] == "friend":
        return "", ""
    if words[0] in {"class", "struct", "enum", "using", "typedef"}:
        is_type = words[0] in {"using", "typedef"} or (has_body and "<" not in head.split(":")[0])
        found = next(filter(None, (pattern.match(text) for pattern in _TYPES)), None)
        return ("class", found[1]) if found and is_type else ("", "")
    found = _FUNCTION.search(f"{head}(")
    is_one = "(" in text and "=" not in head and "operator" not in head and "::" not in words[-1]
    if found and is_one and len(words) > 1 and found[1] not in _NO_FUNCTIONS:
        return "function", found[1]
    return "", ""


def _without_template(text: str) -> str:
    """Return a declaration without the parameters of templates in front of it."""
    while found := _TEMPLATE.match(text):
        depth, index = 1, found.end()
        while index < len(text) and depth:
            depth += {"<": 1, ">": -1}.get(text[index], 0)
            index += 1
        text = text[index:].strip()
    return text
