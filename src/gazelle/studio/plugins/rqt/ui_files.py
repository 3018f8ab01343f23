"""Forms of Qt Designer: which of our widgets stands for each of Qt's."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics

__all__ = ["FormWidget", "form_layout", "form_widgets"]

_COLUMN = "Column"
_CONTAINERS = frozenset(
    {"QWidget", "QFrame", "QGroupBox", "QScrollArea", "QTabWidget", "QDockWidget", "QSplitter",
     "QStackedWidget", "QToolBox", "QDialog", "QMainWindow"}
)  # fmt: skip
_NOTHING = frozenset({"Line", "QMenuBar", "QMenu", "QStatusBar", "QToolBar"})
_DEFAULT_MOST = 99.0


class FormWidget(NamedTuple):
    """A widget of a form.

    Attributes:
        name: its ``objectName``.
        qt: its class in Qt.
        line: in the ``.ui`` file.
        ours: the Python expression that makes ours, empty when there is none.
        note: what to know about it.
    """

    name: str
    qt: str
    line: int
    ours: str
    note: str


def form_widgets(file: Path) -> list[FormWidget]:
    """Return the widgets of a form that a person sees, in order; none when it cannot be read."""
    root = _root(file)
    return list(_widgets(root)) if root is not None else []


def form_layout(file: Path, depth: int) -> list[str]:
    """Return the lines of Python that build our widgets, rows and columns.

    Args:
        file: the ``.ui`` file.
        depth: of the indentation, in steps of four.
    """
    root = _root(file)
    return list(_lines(root, depth)) if root is not None else []


def _root(file: Path) -> Tag | None:
    root = read_xml(file, Diagnostics())
    return root.find("widget") if root is not None else None


def _widgets(tag: Tag) -> Iterator[FormWidget]:
    for child in tag.walk():
        if child.name == "widget" and child is not tag:
            kind = child.attributes.get("class", "")
            if kind not in _CONTAINERS and kind not in _NOTHING:
                yield _one(child)


def _one(tag: Tag) -> FormWidget:
    name, kind = tag.attributes.get("name", ""), tag.attributes.get("class", "")
    make = _MAKERS.get(kind)
    ours, note = make(_identifier(name), tag) if make else ("", _without(kind))
    return FormWidget(name, kind, tag.span.line, ours, note)


def _without(kind: str) -> str:
    if kind == "QGraphicsView":
        return "Image for pictures, Plot for curves; anything else in the panel's ES module"
    return f"nothing of ours stands for {kind}; draw it in the panel's ES module"


def _lines(tag: Tag, depth: int) -> Iterator[str]:
    """Layouts become rows and columns; boxes with a title become columns with one."""
    indent = "    " * depth
    for child in tag.children:
        if child.name == "item":
            yield from _lines(child, depth)
        elif child.name == "layout":
            inside = list(_lines(child, depth + 1))
            if child.attributes.get("class") == "QHBoxLayout" and len(inside) > 1:
                yield from (f"{indent}Row(", *inside, f"{indent}),")
            else:
                yield from (line[4:] for line in inside)
        elif child.name == "widget" and child.attributes.get("class") in _CONTAINERS:
            title = _text(child, "title")
            inside = list(_lines(child, depth + 1))
            if title and inside:
                end = f"{indent}    title={_quoted(title)},"
                yield from (f"{indent}Column(", *inside, end, f"{indent}),")
            else:
                yield from (line[4:] for line in inside)
        elif child.name == "widget" and child.attributes.get("class") not in _NOTHING:
            one = _one(child)
            yield f"{indent}{one.ours}," if one.ours else f"{indent}# {one.name}: {one.note}"


def _property(tag: Tag, name: str) -> Tag | None:
    for child in tag.find_all("property"):
        if child.attributes.get("name") == name and child.children:
            return child.children[0]
    return None


def _text(tag: Tag, name: str) -> str:
    found = _property(tag, name)
    # An ampersand marks the letter of a shortcut.
    return re.sub(r"&(.)", r"\1", found.text) if found is not None else ""


def _number(tag: Tag, name: str, default: float) -> float:
    found = _property(tag, name)
    try:
        return float(found.text) if found is not None else default
    except ValueError:
        return default


def _call(kind: str, name: str, *args: str) -> str:
    return f"{kind}({', '.join((_quoted(name), *(word for word in args if word)))})"


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _labelled(tag: Tag) -> str:
    text = _text(tag, "text")
    return f"text={_quoted(text)}" if text else ""


def _identifier(name: str) -> str:
    made = re.sub(r"\W", "_", name) or "widget"
    return f"_{made}" if made[0].isdigit() else made


def _shown(value: float) -> str:
    return str(int(value)) if value.is_integer() else repr(value)


def _tuple(items: list[str]) -> str:
    inside = ", ".join(_quoted(item) for item in items)
    return f"({inside},)" if len(items) == 1 else f"({inside})"


_Made = tuple[str, str]


def _button(name: str, tag: Tag) -> _Made:
    if _property(tag, "checkable") is not None and _text(tag, "checkable") == "true":
        return _call("Checkbox", name, _labelled(tag)), f"on_{name}(self, on) in place of toggled"
    return _call("Button", name, _labelled(tag)), f"on_{name}(self) in place of clicked"


def _tick(name: str, tag: Tag) -> _Made:
    value = "value=True" if _text(tag, "checked") == "true" else ""
    return _call("Checkbox", name, _labelled(tag), value), f"on_{name}(self, on)"


def _slider(name: str, tag: Tag) -> _Made:
    least, most = _number(tag, "minimum", 0.0), _number(tag, "maximum", _DEFAULT_MOST)
    value = _number(tag, "value", least)
    args = [f"min={_shown(least)}", f"max={_shown(most)}", "step=1"]
    args += [f"value={_shown(value)}"] if value != least else []
    note = f"on_{name}(self, value) in place of valueChanged"
    return _call("Slider", name, *args), note + "; min and max may be the real limits, with unit="


def _spin(name: str, tag: Tag) -> _Made:
    real = tag.attributes.get("class") == "QDoubleSpinBox"
    least, most = _number(tag, "minimum", 0.0), _number(tag, "maximum", _DEFAULT_MOST)
    value = _number(tag, "value", least)
    args = [f"value={value!r}" if real else f"value={_shown(value)}"]
    args += [f"min={_shown(least)}", f"max={_shown(most)}"]
    args += [f"step={_shown(_number(tag, 'singleStep', 1.0))}"]
    unit = _text(tag, "suffix").strip()
    args += [f"unit={_quoted(unit)}"] if unit else []
    return _call("Number", name, *args), f"on_{name}(self, value) in place of valueChanged"


def _choice(name: str, tag: Tag) -> _Made:
    items = [_text(item, "text") for item in tag.find_all("item")]
    options = _tuple([item for item in items if item])
    note = f"on_{name}(self, option); fill it later with self.change({_quoted(name)}, options=…)"
    return _call("Choice", name, f"options={options}"), note


def _line(name: str, tag: Tag) -> _Made:
    args = [f"{ours}={_quoted(_text(tag, qt))}" for qt, ours in
             (("text", "value"), ("placeholderText", "placeholder")) if _text(tag, qt)]  # fmt: skip
    return _call("TextInput", name, *args), f"on_{name}(self, text) in place of editingFinished"


def _label(name: str, tag: Tag) -> _Made:
    text = _text(tag, "text")
    note = "leave it out where it only names its neighbour: widgets have text="
    return _call("Label", name, 'text=" "', f"value={_quoted(text)}" if text else ""), note


def _readout(name: str, tag: Tag) -> _Made:
    return _call("Label", name), f"self[{_quoted(name)}] = value"


def _table(name: str, tag: Tag) -> _Made:
    columns = [_text(column, "text") for column in tag.find_all("column")]
    args = _tuple([column or "…" for column in columns] or ["…"])
    return _call("Table", name, f"columns={args}"), f"self[{_quoted(name)}] = rows"


_MAKERS: dict[str, Callable[[str, Tag], _Made]] = {
    "QCheckBox": _tick,
    "QComboBox": _choice,
    "QCommandLinkButton": _button,
    "QDial": _slider,
    "QDoubleSpinBox": _spin,
    "QLCDNumber": _readout,
    "QLabel": _label,
    "QLineEdit": _line,
    "QListWidget": _table,
    "QPlainTextEdit": _line,
    "QProgressBar": _readout,
    "QPushButton": _button,
    "QRadioButton": _tick,
    "QScrollBar": _slider,
    "QSlider": _slider,
    "QSpinBox": _spin,
    "QTableView": _table,
    "QTableWidget": _table,
    "QTextBrowser": _readout,
    "QTextEdit": _line,
    "QToolButton": _button,
    "QTreeView": _table,
    "QTreeWidget": _table,
}
