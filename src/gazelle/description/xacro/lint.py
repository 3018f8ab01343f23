"""Mistakes that xacro passes in silence: what is left in the result, or had no effect."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from gazelle.description.xacro.error_explanations.files import NAMESPACE
from gazelle.description.xacro.macro_definitions import definitions_in
from gazelle.description.xacro.unprefixed_tags import NEEDED_ATTRIBUTES, OF_ROBOTS
from gazelle.description.xacro.xacro_library import LibraryRun
from gazelle.description.xacro.xml_output import Written
from gazelle.description.xml import Tag, attribute_span, parse_xml, read_xml
from gazelle.diagnostics import Diagnostics, Severity, SourceSpan, did_you_mean
from gazelle.documents import TEXT_BYTES, read_limited

__all__ = ["report_silent_mistakes"]

_ADDRESS = re.compile(r"https?://(www\.|wiki\.)?ros\.org/(wiki/)?xacro/?")
_PREFIXED = re.compile(r'xmlns:(\w+)="(?:https?://(?:www\.|wiki\.)?ros\.org/(?:wiki/)?xacro)/?"')
_COMMA_ATTRIBUTE = re.compile(rb"[\"']\s*[-+]?\d+,\d+\s*[\"']")
_COMMA_VALUE = re.compile(r"\s*[-+]?\d+,\d+\s*")
_SCOPE = re.compile(rb"\sscope\s*=\s*[\"'](?!global[\"']|parent[\"']|local[\"'])")
_SCOPES = ("global", "parent")
_SPLITTERS = (b"tokenize", b".split(")
_TUPLE = re.compile(r"\((-?\d+(?:\.\d+)?), (-?\d+(?:\.\d+)?)\)")


def report_silent_mistakes(
    written: Written,
    library_run: LibraryRun,
    file: str,
    given: dict[str, str],
    diagnostics: Diagnostics,
) -> None:
    """Report what a user would not have meant.

    Args:
        written: the result.
        library_run: the run.
        file: the input file, where arguments of the command line are reported.
        given: values of ``<xacro:arg>`` that the user gave.
        diagnostics: receives warnings and remarks.
    """
    text = written.text
    _report_unprefixed(library_run, diagnostics)
    _report_tags(written, text, library_run, diagnostics)
    for span in written.unexpanded:
        message = "xacro expands nothing inside <![CDATA[…]]>: ${…} is left as it stands"
        fix = "write the text without CDATA, with &lt; and &amp;"
        diagnostics.report("xacro.not-expanded", message, span, fix=fix)
    _report_addresses(text, library_run, diagnostics)
    _report_sources(library_run, diagnostics)
    _report_pairs(text, written, library_run, diagnostics)
    _report_unused(library_run, file, given, diagnostics)


def _report_unprefixed(library_run: LibraryRun, diagnostics: Diagnostics) -> None:
    """Report the tags that were taken for xacro's, once a file."""
    by_file: dict[str, list[tuple[str, SourceSpan | None]]] = {}
    for name, span in library_run.unprefixed or ():
        by_file.setdefault(span.file if span else "", []).append((name, span))
    for tags in by_file.values():
        name, span = tags[0]
        # A macro's body is copied at each call.
        more = len({replace(found, via=()) for _name, found in tags if found}) - 1
        message = f"<{name}> without the prefix 'xacro:' is taken as <xacro:{name}>, as until ROS"
        message += f" Melodic (and {more} more in this file)" if more else " Melodic"
        fix = f"write <xacro:{name} …>, which all versions take"
        diagnostics.report("xacro.unprefixed", message, span, fix=fix)


def _report_tags(
    written: Written, text: str, library_run: LibraryRun, diagnostics: Diagnostics
) -> None:
    suspected = written.names & {*NEEDED_ATTRIBUTES, *library_run.macros}
    root = parse_xml(text, "", Diagnostics()) if suspected else None
    if root is None or root.name != "robot":
        return
    for tag, is_top, span in _outside_plugins(root, iter(written.spans)):
        if tag.name not in suspected:
            continue
        needed = NEEDED_ATTRIBUTES.get(tag.name)
        if needed is not None and needed <= set(tag.attributes):
            message = f"<{tag.name}> without the prefix 'xacro:' is not xacro's; it is left in the"
            message += " result as it stands"
        elif is_top and tag.name in library_run.macros and tag.name not in OF_ROBOTS:
            message = (
                f"macro '{tag.name}' is called without the prefix 'xacro:'; it is not expanded"
            )
        else:
            continue
        diagnostics.report("xacro.not-expanded", message, span, fix=f"write <xacro:{tag.name} …>")


def _outside_plugins(
    root: Tag, spans: Iterator[SourceSpan | None]
) -> Iterator[tuple[Tag, bool, SourceSpan | None]]:
    """Yield the elements with their places, those for Gazebo left out, whose tags are others."""
    next(spans)
    for top in root.children:
        yield top, True, next(spans)
        for tag in list(top.walk())[1:]:
            span = next(spans)
            if top.name != "gazebo":
                yield tag, False, span


def _report_addresses(text: str, library_run: LibraryRun, diagnostics: Diagnostics) -> None:
    for prefix in dict.fromkeys(_PREFIXED.findall(text)):
        span = next(iter(library_run.addresses.values()), None)
        message = f"xacro's address belongs to the prefix '{prefix}:' here, and xacro goes by the"
        message += f" prefix 'xacro:' alone: <{prefix}:…> is left in the result as it stands"
        fix = f'declare xmlns:xacro="{NAMESPACE}" and write <xacro:…>'
        diagnostics.report("xacro.not-expanded", message, span, fix=fix)
    for address, span in library_run.addresses.items():
        if not _ADDRESS.fullmatch(address):
            written_at = attribute_span(span, "xmlns:xacro")
            message = f"'{address}' is not xacro's address; xacro goes by the prefix and takes it"
            diagnostics.report("xacro.namespace-address", message, written_at)


def _report_sources(library_run: LibraryRun, diagnostics: Diagnostics) -> None:
    """Report numbers with a decimal comma, which are texts to Python, and scopes of no effect."""
    for file in dict.fromkeys(library_run.tracker.files):
        data = _bytes_of(file)
        has_commas = _COMMA_ATTRIBUTE.search(data) and not any(word in data for word in _SPLITTERS)
        if not has_commas and not _SCOPE.search(data):
            continue
        root = read_xml(Path(file), Diagnostics())
        for tag in root.walk() if root is not None else ():
            if tag.name == "xacro:property":
                _report_scope(tag, diagnostics)
            if has_commas and tag.name.startswith("xacro:"):
                _report_comma(tag, diagnostics)


def _report_pairs(
    text: str, written: Written, library_run: LibraryRun, diagnostics: Diagnostics
) -> None:
    """Report a pair of numbers in the result that no file has: an expression with a comma."""
    pair = _TUPLE.search(text)
    if pair is None:
        return
    if any(pair[0].encode() in _bytes_of(file) for file in library_run.tracker.files):
        return
    message = f"'{pair[0]}' is in the result: '{pair[1]},{pair[2]}' in an expression is a pair"
    message += " of numbers to Python"
    fix = "write the decimal sign as a dot"
    span = _place_at(written, text.count("\n", 0, pair.start()) + 1)
    diagnostics.report("xacro.decimal-comma", message, span, fix=fix, severity=Severity.WARNING)


def _place_at(written: Written, line: int) -> SourceSpan | None:
    """Return where the last element that starts at or before a line of the result was written."""
    index = bisect_right(written.lines, line) - 1
    return written.spans[index] if index >= 0 else None


def _report_scope(tag: Tag, diagnostics: Diagnostics) -> None:
    scope = tag.attributes.get("scope", "local")
    if scope in {*_SCOPES, "local"} or "$" in scope:
        return
    message = f"there is no scope '{scope}'; the property is known here alone, as without scope"
    fix = did_you_mean(scope, _SCOPES) or "write global or parent"
    span = attribute_span(tag.span, "scope")
    diagnostics.report("xacro.bad-element", message, span, fix=fix, severity=Severity.WARNING)


def _report_comma(tag: Tag, diagnostics: Diagnostics) -> None:
    for name, value in tag.attributes.items():
        if name != "params" and _COMMA_VALUE.fullmatch(value):
            message = f"'{value}' is a text to xacro, not a number: '${{2 * x}}' of it is"
            message += f" '{value.strip() * 2}'"
            fix = f"write the decimal sign as a dot: {value.strip().replace(',', '.')}"
            span = attribute_span(tag.span, name)
            diagnostics.report(
                "xacro.decimal-comma", message, span, fix=fix, severity=Severity.WARNING
            )


def _bytes_of(file: str) -> bytes:
    try:
        return read_limited(file, TEXT_BYTES)
    except OSError:
        return b""


def _report_unused(
    library_run: LibraryRun, file: str, given: dict[str, str], diagnostics: Diagnostics
) -> None:
    """Report values for arguments that no file declares or asks for."""
    unused = [name for name in given if name not in library_run.arguments.names]
    if not unused:
        return
    declared = [item for item in definitions_in(library_run.tracker.files) if item.kind == "arg"]
    names = [item.name for item in declared]
    for name in unused:
        if name in names:
            continue
        hint = did_you_mean(name, names)
        message = f"'{name}:={given[name]}' has no effect: no <xacro:arg> has this name"
        severity = Severity.WARNING if hint else Severity.INFO
        span = SourceSpan(file)
        diagnostics.report("xacro.unused-argument", message, span, fix=hint, severity=severity)
