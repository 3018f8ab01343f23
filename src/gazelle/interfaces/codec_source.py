"""What the two code generators share: lines, constants and where the bytes stand.

CDR aligns every number to its size. Positions count from behind the four bytes of the
encapsulation header. A position is ``o + k``: a variable of the generated code and a number
known while generating; its remainder by some power of two is often known too.
"""

from __future__ import annotations

import struct
from typing import Any

from gazelle.errors import GazelleError
from gazelle.interfaces.definition import Array
from gazelle.interfaces.wire_layout import Layout, Slot, Wire

__all__ = ["Emitter", "fixed_leaves"]


class Emitter:
    """Collects the source of one function.

    Attributes:
        aligned: whether numbers are aligned (CDR) or follow each other (ROS 1).
        endian: ``<`` or ``>``.
        space: names that the generated code uses.
    """

    def __init__(self, wire: Wire, endian: str, head: str) -> None:
        self.aligned = wire is Wire.CDR
        self.endian = endian
        self.space: dict[str, Any] = {}
        self._lines = [head]
        self._depth = 1
        self._names = 0
        self.k = 0
        self._modulus = 8
        self._rest = 0
        self.run_format = ""

    def line(self, text: str) -> None:
        """Add one line at the present depth."""
        self._lines.append(" " * self._depth + text)

    def indent(self, steps: int) -> None:
        """Go deeper or back."""
        self._depth += steps

    def fresh(self, prefix: str) -> str:
        """Return a name not used before."""
        self._names += 1
        return f"{prefix}{self._names}"

    def constant(self, prefix: str, value: Any) -> str:
        """Return the name under which generated code sees a value."""
        name = self.fresh(prefix)
        self.space[name] = value
        return name

    def advance(self, count: int) -> None:
        """Move by bytes of known number."""
        self.k += count
        self._rest = (self._rest + count) % self._modulus

    def forget(self, modulus: int = 1, rest: int = 0) -> None:
        """Note what alone is still known of the position."""
        self._modulus, self._rest = modulus, rest

    def padding(self, size: int) -> int | None:
        """Return the bytes up to the next multiple of `size`; None when only run time knows."""
        if not self.aligned or size == 1:
            return 0
        if self._modulus % size:
            return None
        return -self._rest % size

    def source(self) -> str:
        """Return the function's source."""
        return "\n".join(self._lines)

    def compiled(self, name: str) -> Any:
        """Return the function, compiled.

        Raises:
            GazelleError: the generated source is not valid, which is a fault of the generator.
        """
        text = self.source()
        try:
            exec(text, self.space)  # noqa: S102 - names are checked identifiers of a definition
        except SyntaxError as error:
            raise GazelleError(f"generated codec is not valid: {error}\n{text}") from error
        return self.space[name]


def fixed_leaves(
    layout: Layout, *, aligned: bool, prefix: tuple[str, ...] = ()
) -> list[tuple[tuple[str, ...], str]] | None:
    """Return paths and letters of a message of numbers only, in a layout with no padding.

    Returns:
        None when there is a string, an array, a field on one side only, or, in aligned bytes,
        numbers of different sizes; such messages are handled one by one.
    """
    found: list[tuple[tuple[str, ...], str]] = []
    if layout.missing or not layout.slots:
        return None
    for slot in layout.slots:
        inner = _leaf(slot, aligned, prefix)
        if inner is None:
            return None
        found += inner
    sizes = {struct.calcsize(letter) for _, letter in found}
    return None if aligned and len(sizes) > 1 else found


def _leaf(
    slot: Slot, aligned: bool, prefix: tuple[str, ...]
) -> list[tuple[tuple[str, ...], str]] | None:
    if slot.attribute is None or slot.array is not Array.ONE:
        return None
    path = (*prefix, slot.attribute)
    if slot.child is not None:
        return fixed_leaves(slot.child, aligned=aligned, prefix=path)
    return [(path, slot.letter)] if slot.letter else None
