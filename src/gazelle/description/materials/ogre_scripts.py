"""OGRE ``.material`` scripts, as far as colour and texture."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["OgreMaterial", "parse_material_script"]

_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_WORD = re.compile(r'"[^"\n]*"|[{}]|[^\s{}"]+')
_COLOURS = ("ambient", "diffuse", "specular", "emissive")


@dataclass(slots=True)
class OgreMaterial:
    """One ``material`` block: what its passes and texture units say first.

    Attributes:
        name: as the script writes it.
        base: name of the material it starts from, may be empty.
        colours: 3 to 5 numbers by ``ambient``, ``diffuse``, ``specular``, ``emissive``.
        texture: file name of the first picture, may be empty.
        scale: ``scale`` of the texture unit: the picture is this many times larger.
        lighting: False after ``lighting off``.
        span: place of the ``material`` line.
    """

    name: str
    base: str
    span: SourceSpan
    colours: dict[str, tuple[float, ...]] = field(default_factory=dict)
    texture: str = ""
    scale: tuple[float, float] = (1.0, 1.0)
    lighting: bool = True
    techniques: int = 0


def parse_material_script(
    text: str, file: str, diagnostics: Diagnostics
) -> dict[str, OgreMaterial]:
    """Return the materials of a script by name.

    Only the first technique counts, and within it the first word of each kind, since later
    passes add light to the same surface.

    Args:
        text: the script.
        file: name for the spans.
        diagnostics: receives ``material.bad-script``.
    """
    reader = _ScriptReader(file, diagnostics)
    for line_number, tokens in _lines(text):
        reader.take(line_number, tokens)
    reader.finish()
    return reader.found


def _lines(text: str) -> Iterator[tuple[int, list[str]]]:
    """Yield the words of each line; braces stand alone."""
    # Comments keep their line breaks, so that line numbers stay true.
    bare = _COMMENT.sub(lambda match: "\n" * match.group().count("\n"), text)
    for number, line in enumerate(bare.splitlines(), start=1):
        tokens: list[str] = []
        for token in _WORD.findall(line):
            if token in {"{", "}"}:
                if tokens:
                    yield number, tokens
                    tokens = []
                yield number, [token]
            else:
                tokens.append(token.strip('"'))
        if tokens:
            yield number, tokens


class _ScriptReader:
    def __init__(self, file: str, diagnostics: Diagnostics) -> None:
        self.found: dict[str, OgreMaterial] = {}
        self._file = file
        self._diagnostics = diagnostics
        self._blocks: list[str] = []
        self._header: list[str] = []
        self._header_line = 0
        self._material: OgreMaterial | None = None

    def take(self, line: int, tokens: list[str]) -> None:
        if tokens == ["{"]:
            self._open()
        elif tokens == ["}"]:
            self._close(line)
        else:
            self._header, self._header_line = tokens, line
            self._statement(line, tokens)

    def finish(self) -> None:
        if self._blocks:
            message = f"material script ends inside '{self._blocks[-1]}': a '}}' is missing"
            self._diagnostics.report("material.bad-script", message, SourceSpan(self._file))

    def _open(self) -> None:
        kind = self._header[0] if self._header else ""
        if kind == "material" and not self._blocks:
            self._start_material()
        elif kind == "technique" and self._material is not None:
            self._material.techniques += 1
        self._blocks.append(kind)
        self._header = []

    def _close(self, line: int) -> None:
        if not self._blocks:
            span = SourceSpan(self._file, line)
            message = "a '}' without its '{' in this material script"
            self._diagnostics.report("material.bad-script", message, span)
            return
        if self._blocks.pop() == "material" and not self._blocks:
            self._material = None

    def _start_material(self) -> None:
        name, _, base = " ".join(self._header[1:]).partition(":")
        span = SourceSpan(self._file, self._header_line)
        self._material = OgreMaterial(name.strip(), base.strip(), span)
        self.found.setdefault(self._material.name, self._material)

    def _statement(self, line: int, tokens: list[str]) -> None:
        material = self._material
        if material is None or material.techniques > 1:
            return
        inside, kind, values = self._blocks[-1], tokens[0], tokens[1:]
        if inside == "pass" and kind in _COLOURS and kind not in material.colours:
            if values[:1] != ["vertexcolour"]:
                material.colours[kind] = self._numbers(line, kind, values)
        elif inside == "pass" and kind == "lighting":
            material.lighting = values[:1] != ["off"]
        elif inside == "texture_unit" and kind == "texture" and not material.texture and values:
            material.texture = values[0]
        elif inside == "texture_unit" and kind == "scale" and len(values) == 2:
            material.scale = self._scale(line, values)

    def _scale(self, line: int, values: list[str]) -> tuple[float, float]:
        numbers = self._numbers(line, "scale", values)
        return (numbers[0], numbers[1]) if len(numbers) == 2 and 0.0 not in numbers else (1.0, 1.0)

    def _numbers(self, line: int, kind: str, values: list[str]) -> tuple[float, ...]:
        try:
            return tuple(float(value) for value in values)
        except ValueError:
            span = SourceSpan(self._file, line)
            message = f"'{kind} {' '.join(values)}' in this material script is not a row of numbers"
            self._diagnostics.report("material.bad-script", message, span)
            return ()
