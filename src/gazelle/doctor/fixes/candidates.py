"""What could be written to mend a finding, the most likely first."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import NamedTuple

from gazelle.diagnostics import Diagnostic, SourceSpan
from gazelle.doctor.fixes.by_code import (
    install_rule,
    number_written,
    xacro_closed,
    xacro_command,
    xacro_included,
)
from gazelle.doctor.fixes.edits import Edit, SourceText
from gazelle.doctor.fixes.malformed import python_closed, xml_closed, xml_escaped, yaml_closed
from gazelle.doctor.fixes.misspelt import suggestions, with_names_replaced
from gazelle.doctor.fixes.xml_fixes import as_written, pasted, removed

__all__ = ["Candidate", "candidates", "unreadable"]

_Maker = Callable[[Diagnostic, SourceText, int], Iterator[tuple[Edit, ...]]]
_MAX_CANDIDATES = 12
# Findings that keep the rest of a file from being looked at: whoever mends one may see others.
_UNREADABLE: dict[str, _Maker] = {
    "control.parameter-file": yaml_closed,
    "launch.bad-yaml": yaml_closed,
    "launch_ros2.unreadable": python_closed,
    "package.python-syntax": python_closed,
    "parameters.unreadable": yaml_closed,
    "xml.lenient": xml_escaped,
    "xml.malformed": xml_closed,
    "yaml.malformed": yaml_closed,
}
_OF_CODE: dict[str, _Maker] = {
    "doctor.description-not-expanded": xacro_command,
    "package.not-installed": install_rule,
    "xacro.bad-expression": xacro_closed,
    "xacro.decimal-comma": number_written,
    "xacro.unknown-macro": xacro_included,
    "xml.bad-number": number_written,
}
# Words of fixes that leave something to choose.
_OF_SEVERAL = re.compile(
    r"\bor\b|such as|with the numbers|where it ends|unindent|\bit (?:has|is)\b"
)
_STOPS = (
    "launch.",
    "launch_ros2.",
    "xacro.",
    "xml.",
    "load.",
    "doctor.spawn-fails",
    "doctor.world-missing",
)


class Candidate(NamedTuple):
    """A way to mend a finding.

    Attributes:
        file: that changes.
        edits: of its text.
        is_certain: it is what was meant, not one of several ways or an estimate.
    """

    file: str
    edits: tuple[Edit, ...]
    is_certain: bool = True


def unreadable(code: str) -> bool:
    """Tell whether a finding hides what else is wrong."""
    return code in _UNREADABLE or code.startswith(_STOPS)


def candidates(
    finding: Diagnostic, read: Callable[[str], SourceText | None]
) -> Iterator[Candidate]:
    """Return what could be written to mend a finding, the most likely first.

    Args:
        finding: with a place.
        read: gives the text of a file of the user's, None for what is none.
    """
    count = 0
    seen = set()
    for span in _places(finding):
        source = read(span.file)
        if source is None:
            continue
        at = source.offset(span)
        makers = (
            _UNREADABLE.get(finding.code),
            _OF_CODE.get(finding.code),
            with_names_replaced,
            as_written,
            pasted,
            removed,
        )
        for maker in makers:
            for edits in maker(finding, source, at) if maker else ():
                if (span.file, edits) in seen:
                    continue
                seen.add((span.file, edits))
                yield Candidate(span.file, edits, _is_certain(finding, maker, edits))
                count += 1
                if count >= _MAX_CANDIDATES:
                    return


def _is_certain(finding: Diagnostic, maker: _Maker | None, edits: tuple[Edit, ...]) -> bool:
    if maker is with_names_replaced:
        return all(edit.text == suggestions(finding)[0] for edit in edits)
    if maker in {pasted, xacro_closed} or _OF_SEVERAL.search(finding.fix):
        return False
    return all(edit.text not in {"]", "}"} for edit in edits)


def _places(finding: Diagnostic) -> Iterator[SourceSpan]:
    if finding.span is not None:
        yield finding.span
        yield from finding.span.via
