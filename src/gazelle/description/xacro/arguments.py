"""The command line of ``xacro``, as launch files and shells use it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

__all__ = ["XacroCommand", "parse_xacro_arguments"]

_WITHOUT_VALUE = frozenset({"--inorder", "-i", "--deps", "-q", "-v", "--xacro-ns", "--check-order"})
_WITH_VALUE = frozenset({"-o", "--root-dir", "--verbosity"})
_REMAP = ":="


@dataclass(frozen=True, slots=True)
class XacroCommand:
    """What one call of ``xacro`` asks for.

    Attributes:
        file: the input file, as written.
        mappings: values of ``<xacro:arg>`` by name.
        output: file to write to, empty for standard output.
        root_dir: folder that relative includes start from, empty for the current one.
        just_deps: print the files included instead of the result.
    """

    file: str
    mappings: Mapping[str, str] = field(default_factory=dict)
    output: str = ""
    root_dir: str = ""
    just_deps: bool = False


def parse_xacro_arguments(arguments: Sequence[str]) -> XacroCommand:
    """Read the arguments after the word ``xacro``.

    ``--inorder`` and ``--xacro-ns`` are accepted: both have been the rule since ROS Melodic.

    Args:
        arguments: options, ``name:=value`` and the input file, in any order.

    Raises:
        ValueError: an option is unknown or lacks its value, or there is not exactly one file.
    """
    files: list[str] = []
    mappings: dict[str, str] = {}
    options: dict[str, str] = {}
    rest = list(arguments)
    while rest:
        word = rest.pop(0)
        name, separator, value = word.partition("=")
        if _REMAP in word:
            _add_mapping(word, mappings)
        elif name in _WITH_VALUE:
            if not separator and not rest:
                raise ValueError(f"xacro: {name} needs a value")
            options[name] = value if separator else rest.pop(0)
        elif word in _WITHOUT_VALUE:
            options[word] = word
        elif word.startswith("-"):
            raise ValueError(f"xacro: there is no option {word}")
        else:
            files.append(word)
    if len(files) != 1:
        raise ValueError(f"xacro: expected exactly one input file as argument, got {len(files)}")
    return XacroCommand(
        files[0],
        mappings,
        options.get("-o", ""),
        options.get("--root-dir", ""),
        "--deps" in options,
    )


def _add_mapping(word: str, mappings: dict[str, str]) -> None:
    """Add ``name:=value``; ``_name:=value`` is a node's parameter and not for xacro."""
    name, _, value = (part.strip() for part in word.partition(_REMAP))
    if name and value and not (name.startswith("_") and not name.startswith("__")):
        mappings[name] = value
