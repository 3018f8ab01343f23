"""Source of functions that turn bytes into an object; compiled once per class and wire.

In classes of ROS 2 numeric arrays are read-only numpy views of the bytes; classes of ROS 1 get
tuples, and `bytes` for ``uint8[]``, as genpy makes them.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

from gazelle.interfaces.codec_source import Emitter, fixed_leaves
from gazelle.interfaces.definition import NUMPY_NAMES, Array, RosVersion
from gazelle.interfaces.wire_layout import Layout, Slot, Wire

__all__ = ["compile_reader"]


def compile_reader(layout: Layout, wire: Wire, endian: str = "<") -> Callable[[Any], Any]:
    """Return a function from bytes to an object.

    Args:
        layout: the object's class and the order of its fields in the bytes.
        wire: which bytes; the encapsulation header of CDR is skipped, not looked at.
        endian: byte order of the numbers.
    """
    is_ros1 = layout.ros_version is RosVersion.ROS1
    reader = _Reader(wire, endian, tuples=is_ros1)
    reader.space |= {"N": object.__new__, "unpack": struct.unpack_from}
    keep = "bytes(b)" if is_ros1 else "memoryview(b).toreadonly()"
    reader.line(f"if b.__class__ is not bytes: b = {keep}")
    reader.line("o = 0")
    root = reader.created(layout)
    reader.message(layout, root)
    reader.finish(root)
    found: Callable[[Any], Any] = reader.compiled("read")
    return found


class _Reader(Emitter):
    def __init__(self, wire: Wire, endian: str, *, tuples: bool) -> None:
        super().__init__(wire, endian, "def read(b):")
        self._tuples = tuples
        self._targets: list[str] = []
        self._start = 4 if self.aligned else 0
        self._run_k = 0

    def created(self, layout: Layout) -> str:
        """Add a new object of a class; return the variable that holds it."""
        name = self.fresh("v")
        self.line(f"{name} = N({self.constant('C', layout.cls)})")
        return name

    def message(self, layout: Layout, owner: str) -> None:
        """Read all fields into an object that exists."""
        if not layout.slots and self.aligned:
            self._number("B", self.fresh("_u"))
        for slot in layout.slots:
            unused = slot.attribute is None
            self._slot(slot, self.fresh("_u") if unused else f"{owner}.{slot.attribute}")
        if layout.missing:
            self._fill_missing(layout, owner)

    def finish(self, root: str) -> None:
        """End the function; strings and arrays cut short by the end of the bytes show here."""
        self._flush()
        self.line(f"if len(b) < {self._index()}: raise ValueError('the bytes end too early')")
        self.line(f"return {root}")

    def _fill_missing(self, layout: Layout, owner: str) -> None:
        model = self.constant("M", layout.cls)
        fresh = self.fresh("d")
        if layout.name == "std_msgs/msg/Header":
            self.line(f"{owner}.seq = 0")
            return
        self.line(f"{fresh} = {model}()")
        for attribute in layout.missing:
            self.line(f"{owner}.{attribute} = {fresh}.{attribute}")

    def _slot(self, slot: Slot, target: str) -> None:
        if slot.array is not Array.ONE:
            self._array(slot, target)
        elif slot.child is not None:
            inner = self.created(slot.child)
            self.line(f"{target} = {inner}")
            self.message(slot.child, inner)
        elif slot.letter:
            self._number(slot.letter, target)
        else:
            self._string(slot, target)

    def _number(self, letter: str, target: str) -> None:
        self._align(struct.calcsize(letter))
        if not self.run_format:
            self._run_k = self.k
        self.run_format += letter
        self._targets.append(target)
        self.advance(struct.calcsize(letter))

    def _count(self) -> str:
        name = self.fresh("n")
        self._number("I", name)
        self._flush()
        return name

    def _string(self, slot: Slot, target: str) -> None:
        count = self._count()
        wide = slot.base == "wstring"
        length = f"{count} * 2" if wide else count
        end = f"{count} - 1" if self.aligned and not wide else length
        codec = "utf-16-le" if wide else "utf-8"
        self._to_variable()
        start = self._index()
        self.line(f"{target} = str(b[{start}:{start} + {end}], '{codec}', 'replace')")
        self._moved(length, 2 if wide else 1)

    def _array(self, slot: Slot, target: str) -> None:
        if slot.letter:
            self._numbers(slot, target)
            return
        count = str(slot.size) if slot.array is Array.FIXED else self._count()
        leaves = None
        if slot.child is not None:
            leaves = fixed_leaves(slot.child, aligned=self.aligned)
        if leaves is not None and slot.child is not None:
            self._records(slot.child, leaves, count, target)
        else:
            self._loop(slot, count, target)

    def _numbers(self, slot: Slot, target: str) -> None:
        size = struct.calcsize(slot.letter)
        if slot.array is Array.FIXED:
            self._align(size)
            self._flush()
            self.line(f"{target} = {self._values(slot, str(slot.size), self._index())}")
            self.advance(slot.size * size)
            return
        count = self._count()
        if size == 8 and self.aligned:
            self._eight_start(count)
        value = self._values(slot, count, self._index())
        if not self._tuples and not slot.as_bytes:
            import numpy as np

            empty = np.empty(0, NUMPY_NAMES[slot.letter])
            value += f" if {count} else {self.constant('E', empty)}"
        self.line(f"{target} = {value}")
        self._moved(f"{count} * {size}", size if size < 8 else 4)

    def _values(self, slot: Slot, count: str, start: str) -> str:
        letter = slot.letter
        if slot.as_bytes:
            return f"b[{start}:{start} + {count}]"
        if self._tuples:
            if count.isdigit():
                read = self.constant("U", struct.Struct(f"{self.endian}{count}{letter}"))
                return f"{read}.unpack_from(b, {start})"
            return f"unpack('{self.endian}%d{letter}' % {count}, b, {start})"
        # Only here: messages without arrays of numbers need no numpy, whose import takes long.
        import numpy as np

        self.space["frombuffer"] = np.frombuffer
        kind = self.constant("T", np.dtype(self.endian + NUMPY_NAMES[letter]))
        return f"frombuffer(b, {kind}, {count}, {start})"

    def _eight_start(self, count: str) -> None:
        """Numbers of eight bytes behind a count: padded only when there are any."""
        self.line(f"o = o + {self.k + 7} & -8 if {count} else o + {self.k}")
        self.k = 0
        self.forget(4, 0)

    def _records(
        self,
        layout: Layout,
        leaves: list[tuple[tuple[str, ...], str]],
        count: str,
        target: str,
    ) -> None:
        letters = "".join(letter for _, letter in leaves)
        record = struct.Struct(self.endian + letters)
        first = struct.calcsize(letters[0])
        if first == 8 and self.aligned and not count.isdigit():
            self._eight_start(count)
        else:
            self._align(first)
        self._flush()
        found = self.fresh("l")
        names = {path: self.fresh("x") for path, _ in leaves}
        start = self._index()
        self.line(f"{found} = []")
        read = self.constant("U", record.iter_unpack)
        targets = ", ".join(names.values()) + ","
        self.line(f"for {targets} in {read}(b[{start}:{start} + {count} * {record.size}]):")
        self.indent(1)
        root = self._record_object(layout, (), names)
        self.line(f"{found}.append({root})")
        self.indent(-1)
        self.line(f"{target} = {found}")
        self._moved(f"{count} * {record.size}", min(first, 4) if self.aligned else 1)

    def _record_object(
        self, layout: Layout, path: tuple[str, ...], names: dict[tuple[str, ...], str]
    ) -> str:
        root = self.created(layout)
        for slot in layout.slots:
            inner = (*path, slot.attribute or "")
            value = names[inner] if slot.child is None else ""
            if slot.child is not None:
                value = self._record_object(slot.child, inner, names)
            self.line(f"{root}.{slot.attribute} = {value}")
        return root

    def _loop(self, slot: Slot, count: str, target: str) -> None:
        self._to_variable()
        found = self.fresh("l")
        if slot.child is not None and not slot.child.slots:
            self.line(f"if {count} > len(b): raise ValueError('a count is beyond the bytes')")
        self.line(f"{found} = []")
        self.line(f"for {self.fresh('_i')} in range({count}):")
        self.indent(1)
        self.forget()
        item = self.fresh("s")
        if slot.child is not None:
            item = self.created(slot.child)
            self.message(slot.child, item)
        else:
            self._string(slot, item)
        self._to_variable()
        self.line(f"{found}.append({item})")
        self.indent(-1)
        self.forget()
        self.line(f"{target} = {found}")

    def _align(self, size: int) -> None:
        pad = self.padding(size)
        if pad is None:
            self._flush()
            self.line(f"o = o + {self.k + size - 1} & -{size}")
            self.k = 0
            self.forget(size, 0)
        elif pad:
            if self.run_format:
                self.run_format += "x" * pad
            self.advance(pad)

    def _index(self) -> str:
        offset = self.k + self._start
        return f"o + {offset}" if offset else "o"

    def _to_variable(self) -> None:
        """Bring the position wholly into ``o``."""
        self._flush()
        if self.k:
            self.line(f"o += {self.k}")
            self.k = 0

    def _moved(self, count: str, modulus: int) -> None:
        """Count bytes whose number only run time knows; they are a multiple of `modulus`."""
        self.line(f"o += {count} + {self.k}" if self.k else f"o += {count}")
        self.k = 0
        keep = self.padding(modulus) if self.aligned else None
        if keep is None:
            self.forget()
        else:
            self.forget(modulus, -keep % modulus)

    def _flush(self) -> None:
        if not self.run_format:
            return
        read = self.constant("U", struct.Struct(self.endian + self.run_format).unpack_from)
        targets = ", ".join(self._targets) + ","
        offset = self._run_k + self._start
        self.line(f"{targets} = {read}(b, o + {offset})")
        self.run_format, self._targets = "", []
