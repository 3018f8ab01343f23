"""Damage done to files, the same for the same number."""

from __future__ import annotations

import random
import re
from collections.abc import Callable

__all__ = ["damaged"]

WORDS = (
    "", "nan", "inf", "-inf", "1e308", "1e999", "-0", "-1", "0,5", "1,5", "99999999999999999999",
    "../..", "$(find x)", "${x}", "<", ">", "&amp;", "&", "é", "\U0001f916", "\u202e", "\x00",
    "0 0 0", "true", "]]>", "*a", "&a [*a]", "{", "[", "- ", ": ", "'", '"', "\t", "%s",
    "/dev/zero", "file:///dev/zero", "package://x/y.stl", "model://x", "0x7fffffff", "4294967295",
    "-2147483648",
)  # fmt: skip
_NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
_TOKEN = re.compile(r"\w+|[^\w\s]")
_ATTRIBUTE = re.compile(r'(?<![\w:])[\w:]+="[^"]*"')
_ELEMENT = re.compile(r"<(\w+)[^<>]*/>|<(\w+)[^<>]*>[^<]*</\2>")
_DEEP = ("<a>", "[", "{a: ", "<link>", "(")
_DOCTYPES = (
    '<!DOCTYPE a [<!ENTITY b "haha"><!ENTITY c "&b;&b;&b;&b;&b;&b;&b;&b;">]>',
    '<!DOCTYPE a SYSTEM "file:///etc/passwd">',
    '<!DOCTYPE a [<!ENTITY % x SYSTEM "file:///etc/passwd"> %x;]>',
    '<xi:include xmlns:xi="http://www.w3.org/2001/XInclude" href="file:///etc/passwd"/>',
)
_HUGE = (
    b"\xff\xff\xff\xff",
    b"\x00\x00\x00\x80",
    b"\xff\xff\xff\x7f",
    b"\x00\x00\xc0\x7f",
    b"\0" * 4,
)

Chance = random.Random


def damaged(data: bytes, number: int) -> bytes:
    """Return a file's bytes after one to four accidents."""
    chance = Chance(number)
    is_text = b"\0" not in data
    for _ in range(chance.randint(1, 4)):
        if not is_text or chance.random() < 0.1:
            data = chance.choice(_BYTES)(data, chance)
        else:
            text = chance.choice(_TEXTS)(data.decode("utf-8", "replace"), chance)
            data = text.encode("utf-8", "surrogatepass")
        if not data:
            return b"<"
    return _encoded(data, chance) if is_text else data


def _cut(text: str, chance: Chance) -> tuple[str, str, str]:
    start = chance.randrange(len(text))
    end = min(len(text), start + chance.choice((1, 3, 10, 60, 300)))
    return text[:start], text[start:end], text[end:]


def _replaced(text: str, chance: Chance) -> str:
    before, piece, after = _cut(text, chance)
    other = chance.randrange(len(text))
    near = text[other : other + len(piece)]
    return (
        before
        + chance.choice(("", piece * 2, near, chance.choice(WORDS), piece.swapcase()))
        + after
    )


def _truncated(text: str, chance: Chance) -> str:
    return text[: chance.randrange(len(text))]


def _other_number(text: str, chance: Chance) -> str:
    return _one_replaced(_NUMBER, text, chance, lambda _old: chance.choice(WORDS))


def _swapped_tokens(text: str, chance: Chance) -> str:
    found = list(_TOKEN.finditer(text))
    if len(found) < 2:
        return text
    one, two = sorted(chance.sample(found, 2), key=lambda match: match.start())
    middle = text[one.end() : two.start()]
    return text[: one.start()] + two[0] + middle + one[0] + text[two.end() :]


def _other_attribute(text: str, chance: Chance) -> str:
    others = _ATTRIBUTE.findall(text)
    return _one_replaced(
        _ATTRIBUTE, text, chance, lambda old: chance.choice(("", f"{old} {old}", *others[:50]))
    )


def _other_element(text: str, chance: Chance) -> str:
    def change(old: str) -> str:
        return chance.choice(("", old * 2, old * 40, old.replace("<", "<x", 1), f"<b>{old}</b>"))

    return _one_replaced(_ELEMENT, text, chance, change)


def _nested(text: str, chance: Chance) -> str:
    before, piece, after = _cut(text, chance)
    return before + chance.choice(_DEEP) * chance.choice((3, 120, 2000)) + piece + after


def _with_doctype(text: str, chance: Chance) -> str:
    head, end, rest = text.partition("?>")
    document = chance.choice(_DOCTYPES)
    return f"{head}{end}{document}{rest}" if end else f"{document}{text}"


def _long(text: str, chance: Chance) -> str:
    before, piece, after = _cut(text, chance)
    return before + (piece or " ") * chance.choice((100, 1000)) + after


def _one_replaced(
    pattern: re.Pattern[str], text: str, chance: Chance, new: Callable[[str], str]
) -> str:
    found = list(pattern.finditer(text))
    if not found:
        return text
    match = chance.choice(found)
    return text[: match.start()] + new(match[0]) + text[match.end() :]


def _flipped(data: bytes, chance: Chance) -> bytes:
    changed = bytearray(data)
    for _ in range(chance.choice((1, 1, 8))):
        changed[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
    return bytes(changed)


def _huge_count(data: bytes, chance: Chance) -> bytes:
    at = chance.choice((chance.randrange(len(data)), min(80, len(data) - 1), min(8, len(data) - 1)))
    return data[:at] + chance.choice(_HUGE) + data[at + 4 :]


def _shortened(data: bytes, chance: Chance) -> bytes:
    start = chance.randrange(len(data))
    return data[:start] + data[start + chance.choice((1, 4, 50, 10**6)) :]


def _encoded(data: bytes, chance: Chance) -> bytes:
    """Write a text in another encoding now and then, mostly not the one it declares."""
    way = chance.randrange(40)
    text = data.decode("utf-8", "replace") if way < 5 else ""
    if way == 0:
        return text.encode("utf-16", "replace")
    if way == 1:
        return text.encode("latin-1", "replace")
    if way == 2:
        return b"\xef\xbb\xbf" + data
    if way == 3:
        names = ("utf-7", "klingon", "utf-16", "ISO-8859-1", "ascii", "\u00e9")
        return f'<?xml version="1.0" encoding="{chance.choice(names)}"?>'.encode() + data
    return text.encode("utf-32", "replace") if way == 4 else data


_TEXTS: tuple[Callable[[str, Chance], str], ...] = (
    _replaced, _replaced, _replaced, _truncated, _other_number, _other_number, _swapped_tokens,
    _other_attribute, _other_element, _nested, _with_doctype, _long,
)  # fmt: skip
_BYTES: tuple[Callable[[bytes, Chance], bytes], ...] = (_flipped, _huge_count, _shortened)
