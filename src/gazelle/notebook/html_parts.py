"""Pieces of HTML that all renderers share: figures, tables, lists; themed by the page around."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Sequence
from html import escape
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "MAX_PICTURE_PX",
    "figure",
    "number_text",
    "picture_tag",
    "png_of",
    "png_text",
    "short_text",
    "table",
    "tree",
]

MAX_PICTURE_PX = 960
"""Longer side of a picture in a notebook."""

_MAX_ROWS = 200
_MAX_TEXT = 300
# JupyterLab's, VS Code's, and what the page around has.
_COLOUR = "color:var(--jp-content-font-color1,var(--vscode-foreground,currentColor))"
_FONT = "font:13px/1.45 system-ui,sans-serif"
_CELL = "text-align:left;padding:1px 12px 1px 0;vertical-align:top;background:none;border:0"


def figure(inside: str, caption: str = "") -> str:
    """Return what is shown, with words below it (plain text)."""
    words = f'<div style="opacity:.75;margin-top:2px">{escape(caption)}</div>' if caption else ""
    return f'<div style="{_FONT};{_COLOUR};max-width:100%">{inside}{words}</div>'


def png_of(pixels: NDArray[Any], *, is_crisp: bool = False) -> bytes:
    """Return a PNG of grey (H, W) or coloured (H, W, 3 or 4) uint8 pixels, made smaller if large.

    Args:
        pixels: of the picture.
        is_crisp: pixels stand for themselves, as a map's cells do: none is averaged, and small
            pictures are enlarged.
    """
    from PIL import Image

    image = Image.fromarray(pixels)
    longer = max(image.size)
    if longer > MAX_PICTURE_PX:
        width, height = (max(1, round(side * MAX_PICTURE_PX / longer)) for side in image.size)
        size = (width, height)
        image = image.resize(size, Image.Resampling.NEAREST if is_crisp else Image.Resampling.BOX)
    elif is_crisp and longer < MAX_PICTURE_PX // 4:
        factor = MAX_PICTURE_PX // 2 // longer
        size = (image.width * factor, image.height * factor)
        image = image.resize(size, Image.Resampling.NEAREST)
    data = io.BytesIO()
    image.save(data, "PNG", optimize=False)
    return data.getvalue()


def png_text(data: bytes) -> str:
    """Return a PNG as bundles hold it."""
    return base64.b64encode(data).decode("ascii")


def picture_tag(data: bytes, alt: str) -> str:
    """Return an ``<img>`` that carries its PNG with it."""
    return (
        f'<img alt="{escape(alt, quote=True)}" style="max-width:100%;display:block" '
        f'src="data:image/png;base64,{png_text(data)}">'
    )


def table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """Return a table of texts and numbers; rows beyond the 200th are counted."""
    cells = "".join(f'<th style="{_CELL};opacity:.7">{escape(name)}</th>' for name in head)
    lines = [f"<tr>{cells}</tr>"] if head else []
    left = 0
    for number, row in enumerate(rows):
        if number >= _MAX_ROWS:
            left += 1
            continue
        texts = (escape(number_text(item)) for item in row)
        cells = "".join(f'<td style="{_CELL}">{text}</td>' for text in texts)
        lines.append(f"<tr>{cells}</tr>")
    more = f'<div style="opacity:.7">… and {left} more</div>' if left else ""
    return f'<table style="border-collapse:collapse;margin:2px 0">{"".join(lines)}</table>{more}'


def tree(lines: Iterable[tuple[int, str, str]]) -> str:
    """Return an indented list.

    Args:
        lines: depth, name and a remark of each, from the top.
    """
    shown: list[str] = []
    left = 0
    for depth, name, remark in lines:
        if len(shown) >= _MAX_ROWS:
            left += 1
            continue
        text = f'<span style="opacity:.65"> {escape(remark)}</span>' if remark else ""
        shown.append(f'<div style="padding-left:{depth * 1.2:.1f}em">{escape(name)}{text}</div>')
    more = f"<div>… and {left} more</div>" if left else ""
    return f'<div style="margin:2px 0">{"".join(shown)}{more}</div>'


def number_text(value: Any) -> str:
    """Return a value for people: six digits of a number, the beginning of a long text."""
    if isinstance(value, Real) and not isinstance(value, Integral):
        return f"{float(value):.6g}"
    return short_text(str(value))


def short_text(text: str) -> str:
    """Return a text, its beginning where it is long."""
    return text if len(text) <= _MAX_TEXT else f"{text[: _MAX_TEXT - 1]}…"
