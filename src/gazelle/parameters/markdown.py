"""Tables as markdown, for the generated pages of the documentation."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from gazelle.parameters.table import Parameter, ParameterTable

__all__ = ["facts", "headed", "in_code", "only_in", "parameter_lines", "table_section"]


def headed(*titles: str) -> list[str]:
    """Return the head of a table: its titles and the line below them."""
    return [_line(titles).replace("|  |", "| |"), _line(["---"] * len(titles))]


def parameter_lines(rows: Sequence[Parameter], title: str) -> list[str]:
    """Return all parameters as one table, other names in a column of their own.

    Args:
        rows: refused ones among them have no default.
        title: of the first column.
    """
    if not rows:
        return []
    head = headed(title, "other names", "default", "unit", "meaning")
    return ["", *head, *map(_parameter_line, rows)]


def table_section(table: ParameterTable) -> str:
    """Return the section of one table: what has an effect, and a list of what has none."""
    lines = [f"### {table.family}", "", table.summary, ""]
    if table.types:
        lines += [f"Types: {in_code(table.types)}", ""]
    honoured = [_honoured_line(row) for row in table.rows if not row.is_refused]
    if honoured:
        lines += [*headed("parameter", "default", "unit", "meaning"), *honoured]
    idle = [f"- `{row.key}`: {row.meaning}" for row in table.rows if row.is_refused]
    if idle:
        lines += [*([""] if honoured else []), "Without effect:", "", *idle]
    return "\n".join(lines).rstrip()


def facts(behaviour: Iterable[str]) -> list[str]:
    """Return sentences as a list below what stands before."""
    lines = [f"- {fact}" for fact in behaviour]
    return ["", *lines] if lines else []


def in_code(names: Iterable[str]) -> str:
    """Return names in the type of code, with commas between."""
    return ", ".join(f"`{name}`" for name in names)


def only_in(ros_versions: tuple[int, ...]) -> str:
    """Return which generation of ROS has something, empty for both."""
    return "" if len(ros_versions) > 1 else f" (ROS {ros_versions[0]})"


def _parameter_line(row: Parameter) -> str:
    default = "" if row.is_refused or row.default is None else f"`{row.default}`"
    if row.ros2_default is not None:
        default += f", in ROS 2 `{row.ros2_default}`"
    only = only_in(row.ros_versions)
    meaning = row.meaning + (" *(live)*" if row.live else "")
    meaning += "" if only and only in meaning else only
    return _line([f"`{row.key}`", in_code(row.aliases), default, row.unit, meaning])


def _honoured_line(row: Parameter) -> str:
    default = "" if row.default is None else f"`{row.default}`"
    if row.ros2_default is not None:
        default += f", in ROS 2 `{row.ros2_default}`"
    meaning = row.meaning.replace("|", "\\|") + (" *(live)*" if row.live else "")
    meaning += only_in(row.ros_versions)
    return _line([in_code(row.names), default, row.unit, meaning])


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"
