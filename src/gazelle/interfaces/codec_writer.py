"""Source of functions that turn an object into bytes; compiled once per class and wire.

Runs of numbers become one `struct` call, nested messages are part of it, numeric arrays are
handed over as they are, and the pieces are joined once.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

from gazelle.interfaces.codec_runtime import (
    ENCAPSULATION_LE,
    END_PADS,
    PADS,
    packer,
    too_long,
    wrong_length,
)
from gazelle.interfaces.codec_source import Emitter, fixed_leaves
from gazelle.interfaces.definition import Array
from gazelle.interfaces.wire_layout import Layout, Slot, Wire

__all__ = ["compile_writer"]


def compile_writer(layout: Layout, wire: Wire) -> Callable[[Any], bytes]:
    """Return a function from an object to its bytes, little endian.

    Args:
        layout: the object's class and the order of its fields in the bytes.
        wire: which bytes; CDR starts with its encapsulation header.
    """
    writer = _Writer(wire, "<", "def write(m):")
    writer.space |= {
        "too_long": too_long,
        "wrong_length": wrong_length,
    }
    writer.message(layout, "m")
    writer.finish()
    found: Callable[[Any], bytes] = writer.compiled("write")
    return found


class _Writer(Emitter):
    def __init__(self, wire: Wire, endian: str, head: str) -> None:
        super().__init__(wire, endian, head)
        self._arguments: list[str] = []
        self._open_string = False
        self._chunks = False
        if self.aligned:
            self.run_format = "I"
            self._arguments = [str(ENCAPSULATION_LE)]

    def finish(self) -> None:
        """End the function: one `struct` call where that is all, else the joined pieces."""
        if not self._chunks:
            name = self.constant("K", struct.Struct(self.endian + self.run_format).pack)
            self._lines.append(f" return {name}({', '.join(self._arguments)})")
            return
        self._flush()
        self._close_string()
        self._lines[1:1] = [" p = []", " ap = p.append", " o = 0"]
        self.line("return b''.join(p)")

    def message(self, layout: Layout, value: str) -> None:
        """Write all fields of an object that the expression `value` yields."""
        if not layout.slots and self.aligned:
            self._number("B", "0")  # rosidl gives empty messages one byte
        for slot in layout.slots:
            self._slot(layout, slot, value)

    def _slot(self, layout: Layout, slot: Slot, owner: str) -> None:
        if slot.attribute is None:
            value = self.constant("D", slot.default)
        else:
            value = f"{owner}.{slot.attribute}"
        label = f"{layout.name}: '{slot.attribute}'"
        if slot.array is not Array.ONE:
            self._array(slot, value, label)
        elif slot.child is not None:
            name = self.fresh("v")
            self.line(f"{name} = {value}")
            self.message(slot.child, name)
        elif slot.letter:
            self._number(slot.letter, self._byte(value) if slot.base == "byte" else value)
        else:
            self._string(slot, value, label)

    @staticmethod
    def _byte(value: str) -> str:
        return f"({value} if {value}.__class__ is not bytes else {value}[0])"

    def _number(self, letter: str, expression: str) -> None:
        self._align(struct.calcsize(letter))
        self.run_format += letter
        self._arguments.append(expression)
        self.advance(struct.calcsize(letter))

    def _string(self, slot: Slot, value: str, label: str) -> None:
        text = self.fresh("s")
        wide = slot.base == "wstring"
        encode = f"{value}.encode('utf-16-le')" if wide else f"{value}.encode()"
        self.line(f"{text} = {encode}")
        self._bound(slot.string_bound, f"len({text})", label)
        extra = "" if not self.aligned or wide else " + 1"
        count = f"len({text}) // 2" if wide else f"len({text}){extra}"
        self._number("I", count)
        self._chunk(text)
        self._moved(f"len({text})", 2 if wide else 1)
        self._open_string = self.aligned and not wide

    def _array(self, slot: Slot, value: str, label: str) -> None:
        name = self.fresh("a")
        self.line(f"{name} = {value}")
        if slot.letter:
            self._numbers(slot, name, label)
            return
        if slot.array is Array.FIXED:
            self._length(slot.size, f"len({name})", label)
        else:
            self._bound(slot.size, f"len({name})", label)
            self._number("I", f"len({name})")
        leaves = None
        if slot.child is not None:
            leaves = fixed_leaves(slot.child, aligned=self.aligned)
        if leaves is not None:
            self._records(leaves, name)
        else:
            self._loop(slot, name, label)

    def _bound(self, bound: int, count: str, label: str) -> None:
        if bound:
            self.line(f"if {count} > {bound}: too_long({label!r}, {count}, {bound})")

    def _length(self, size: int, count: str, label: str) -> None:
        self.line(f"if {count} != {size}: wrong_length({label!r}, {count}, {size})")

    def _numbers(self, slot: Slot, name: str, label: str) -> None:
        """A numeric array: numpy arrays as they are, anything else is packed one by one."""
        size = struct.calcsize(slot.letter)
        pack = self.constant("F", packer(slot.letter, label))
        count = self.fresh("n")
        self.line(f"{name}, {count} = {pack}({name})")
        if slot.array is Array.FIXED:
            self._length(slot.size, count, label)
            self._align(size)
            self._chunk(name)
            self.advance(slot.size * size)
            return
        self._bound(slot.size, count, label)
        self._number("I", count)
        if size == 8 and self.aligned:
            self._flush()
            self._aligned_tail(count, name, count + " * 8")
        else:
            self._chunk(name)
            self._moved(f"{count} * {size}", size)

    def _aligned_tail(self, count: str, chunk: str, length: str) -> None:
        """Numbers of eight bytes behind a count: padded only when there are any."""
        pad = self.padding(8)
        pads = self.constant("Z", PADS[8])
        position = f"o + {self.k}"
        padding = f"{pads}[{position} & 7]" if pad is None else repr(bytes(pad))
        self.line(f"if {count}:")
        if pad != 0:
            self.line(f" ap({padding})")
        self.line(f" ap({chunk})")
        self.line(f" o = ({position} + 7 & -8) + {length}")
        self.line(f"else: o += {self.k}")
        self.k = 0
        self.forget(4, 0)
        self._chunks = True

    def _records(self, leaves: list[tuple[tuple[str, ...], str]], name: str) -> None:
        """A sequence of messages of numbers without padding: one `struct` call each."""
        letters = "".join(letter for _, letter in leaves)
        pack = self.constant("K", struct.Struct(self.endian + letters).pack)
        values = ", ".join("e." + ".".join(path) for path, _ in leaves)
        joined = self.fresh("c")
        self._flush()
        self.line(f"{joined} = b''.join([{pack}({values}) for e in {name}])")
        first = struct.calcsize(letters[0])
        if first == 8 and self.aligned:
            self._aligned_tail(name, joined, f"len({joined})")
        else:
            self._align(first)
            self._chunk(joined)
            self._moved(f"len({joined})", first if self.aligned else 1)

    def _loop(self, slot: Slot, name: str, label: str) -> None:
        self._settle()
        item = self.fresh("e")
        self.line(f"for {item} in {name}:")
        self.indent(1)
        if slot.child is not None:
            self.message(slot.child, item)
            if not slot.child.slots and not self.aligned:
                self.line("pass")
        else:
            self._string(slot, item, label)
        self._settle()
        self.indent(-1)

    def _settle(self) -> None:
        """Bring the position wholly into ``o``, at the edges of a loop."""
        self._flush()
        self._close_string()
        if self.aligned and self.k:
            self.line(f"o += {self.k}")
        self.k = 0
        self.forget()
        self._chunks = True

    def _align(self, size: int) -> None:
        if not self.aligned:
            return
        if self._open_string:
            self._open_string = False
            if size == 1:
                self.run_format += "x"
                self.advance(1)
            else:
                self._runtime_pad(size, END_PADS[size], size)
            return
        pad = self.padding(size)
        if pad is None:
            self._flush()
            self._runtime_pad(size, PADS[size], size - 1)
        elif pad:
            self.run_format += "x" * pad
            self.advance(pad)

    def _runtime_pad(self, size: int, pads: tuple[bytes, ...], up: int) -> None:
        table = self.constant("Z", pads)
        self.line(f"ap({table}[o + {self.k} & {size - 1}])")
        self.line(f"o = o + {self.k + up} & -{size}")
        self.k = 0
        self.forget(size, 0)
        self._chunks = True

    def _close_string(self) -> None:
        if self._open_string:
            self._open_string = False
            self.line("ap(b'\\0')")
            self.advance(1)

    def _chunk(self, name: str) -> None:
        self._flush()
        self._close_string()
        self.line(f"ap({name})")
        self._chunks = True

    def _moved(self, count: str, modulus: int) -> None:
        """Count bytes whose number only run time knows; they are a multiple of `modulus`."""
        if self.aligned:
            self.line(f"o += {count} + {self.k}" if self.k else f"o += {count}")
            self.k = 0
            keep = self.padding(modulus)
            self.forget(modulus, -keep % modulus if keep is not None else 0)
            if keep is None:
                self.forget()

    def _flush(self) -> None:
        if not self.run_format:
            return
        name = self.constant("K", struct.Struct(self.endian + self.run_format).pack)
        self.line(f"ap({name}({', '.join(self._arguments)}))")
        self.run_format, self._arguments = "", []
        self._chunks = True
