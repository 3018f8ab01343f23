"""The functions of a kernel and of all that it calls, as one program in LLVM's language."""

from __future__ import annotations

from typing import Any

from gazelle.kernels.array_operations import MEMORY
from gazelle.kernels.calls import DECLARATIONS
from gazelle.kernels.kernel_types import KernelType
from gazelle.kernels.lowering import Compiled, lowered
from gazelle.kernels.source import External, KernelSource, Use, fingerprint

__all__ = ["Program"]


class Program:
    """Functions that call each other.

    Attributes:
        uses: what they depend on.
    """

    def __init__(self) -> None:
        """Begin with none."""
        self.uses: dict[tuple[str, str], Use] = {}
        self._functions: dict[tuple[KernelSource, tuple[KernelType, ...]], Compiled] = {}
        self._begun: list[tuple[KernelSource, tuple[KernelType, ...]]] = []
        self._texts: list[str] = []
        self._externals: dict[str, External] = {}

    def function(self, source: KernelSource, types: tuple[KernelType, ...]) -> Compiled:
        """Return a kernel for arguments of some types, compiled where it is not yet.

        Raises:
            TypeError: something in its source is not for kernels, with its place.
        """
        key = source, types
        if key in self._begun:
            raise TypeError(f"{source.name} calls itself")
        if key not in self._functions:
            number = len(self._functions) + len(self._begun)
            name = f'@"{source.function.__qualname__}.{number}"'
            self._begun.append(key)
            try:
                text, self._functions[key] = lowered(self, source, types, name)
            finally:
                self._begun.pop()
            self._texts.append(text)
        return self._functions[key]

    def note_use(self, module: str, name: str, thing: Any) -> None:
        """Note that what is compiled depends on something of a module."""
        if found := fingerprint(thing):
            self.uses[module, name] = Use(module, name, found)

    def external(self, function: External) -> str:
        """Return the name of a library's function."""
        self._externals[function.name] = function
        return f"@{function.name}"

    def text(self) -> str:
        """Return the program in LLVM's language."""
        words = [
            f"declare void @{one.name}({', '.join(['i64'] * one.arguments)}) nounwind"
            for one in self._externals.values()
        ]
        return "\n".join((MEMORY, DECLARATIONS, *words, *self._texts))
