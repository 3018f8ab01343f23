"""A function of LLVM's intermediate language while it is written, as text."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

__all__ = ["FunctionText"]


class FunctionText:
    """Writes instructions one after the other.

    Attributes:
        is_closed: the block has ended: what is written is not reached, and dropped.
        flags: of arithmetic with floats, with a space behind where there are any.
    """

    def __init__(self, flags: str = "") -> None:
        """Begin with an empty block."""
        self.flags = flags
        self.is_closed = False
        self.block = "entry"
        self._first: list[str] = []
        self._lines: list[str] = []
        self._count = 0

    def name(self) -> str:
        """Return a name nothing has yet."""
        self._count += 1
        return f"%v{self._count}"

    def label(self) -> str:
        """Return a name for a block."""
        self._count += 1
        return f"b{self._count}"

    def let(self, instruction: str) -> str:
        """Write an instruction and return the name of its result."""
        name = self.name()
        self.do(f"{name} = {instruction}")
        return name

    def do(self, instruction: str) -> None:
        """Write an instruction without a result."""
        if not self.is_closed:
            self._lines.append(f"  {instruction}")

    def room(self, kind: str, count: int = 1, align: int = 0) -> str:
        """Return the address of memory that the function has for itself as long as it runs."""
        name = self.name()
        many = f", i64 {count}" if count != 1 else ""
        self._first.append(f"  {name} = alloca {kind}{many}{f', align {align}' if align else ''}")
        return name

    def begin(self, label: str) -> None:
        """Begin a block, after the one before has gone on to it."""
        if not self.is_closed:
            self.go_to(label)
        self._lines.append(f"{label}:")
        self.block, self.is_closed = label, False

    def go_to(self, label: str) -> None:
        """End the block."""
        self.do(f"br label %{label}")
        self.is_closed = True

    def choose(self, condition: str, then: str, otherwise: str) -> None:
        """End the block with two ways to go on."""
        if condition in ("true", "false"):
            self.go_to(then if condition == "true" else otherwise)
            return
        self.do(f"br i1 {condition}, label %{then}, label %{otherwise}")
        self.is_closed = True

    def merged(self, kind: str, ways: Sequence[tuple[str, str]]) -> str:
        """Return what the block that was taken has left: pairs of an operand and a block."""
        words = ", ".join(f"[ {operand}, %{block} ]" for operand, block in ways)
        return self.let(f"phi {kind} {words}")

    @contextmanager
    def aside(self, lines: list[str]) -> Iterator[None]:
        """Write to other lines meanwhile."""
        before, self._lines = self._lines, lines
        yield
        self._lines = before

    def take(self, lines: list[str]) -> None:
        """Write lines that were written aside."""
        self._lines += lines

    def count_up(
        self, many: str, each: Callable[[str], None], *, first: str = "0", kind: str = "i64"
    ) -> None:
        """Write a loop over the numbers below one."""
        test, body, end = self.label(), self.label(), self.label()
        place = self.room(kind)
        self.do(f"store {kind} {first}, ptr {place}")
        self.begin(test)
        number = self.let(f"load {kind}, ptr {place}")
        self.choose(self.let(f"icmp slt {kind} {number}, {many}"), body, end)
        self.begin(body)
        each(number)
        self.do(f"store {kind} {self.let(f'add nsw {kind} {number}, 1')}, ptr {place}")
        self.go_to(test)
        self.begin(end)

    def text(self, head: str, opening: Sequence[str] = ()) -> str:
        """Return the whole function, `opening` after the memory it has for itself."""
        lines = [f"{head} {{", "entry:", *self._first, *(f"  {line}" for line in opening)]
        return "\n".join((*lines, *self._lines, "}", ""))
