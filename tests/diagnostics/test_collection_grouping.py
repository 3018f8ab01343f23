from __future__ import annotations

from gazelle.diagnostics import Diagnostics, Severity, SourceSpan
from gazelle.diagnostics.collection import grouped


def _found(*entries: tuple[str, int], severity: Severity | None = None, file: str = "r.urdf"):
    diagnostics = Diagnostics()
    for message, line in entries:
        diagnostics.report("urdf.no-inertia", message, SourceSpan(file, line), severity=severity)
    return diagnostics


def test_findings_that_differ_in_a_name_become_one() -> None:
    words = [
        (f"link '{name}' has no <inertial>", line)
        for name, line in zip("abc", (2, 5, 9), strict=True)
    ]
    (only,) = grouped(_found(*words))
    assert only.span.line == 2
    assert only.message == (
        "link 'a' has no <inertial>\n  the same 2 more times: 'b' (line 5), 'c' (line 9)"
    )


def test_places_of_an_equal_finding_are_listed_together() -> None:
    (only,) = grouped(_found(*[("<axis> has no attribute 'rpy'", line) for line in (3, 4, 8)]))
    assert only.message.endswith("the same 2 more times: line 4, line 8")


def test_two_findings_stay_two() -> None:
    assert len(grouped(_found(("link 'a' is bare", 1), ("link 'b' is bare", 2)))) == 2


def test_numbers_do_not_keep_findings_apart() -> None:
    words = [
        (f"link '{name}': {mass} kg are used", 1)
        for name, mass in zip("abc", (1, 2.5, 3e-5), strict=True)
    ]
    assert len(grouped(_found(*words))) == 1


def test_errors_are_merged_only_when_they_say_the_same() -> None:
    different = [(f"link '{name}' is broken", 1) for name in "abcd"]
    assert len(grouped(_found(*different, severity=Severity.ERROR))) == 4
    equal = [("model 'm' is missing", line) for line in range(1, 5)]
    assert len(grouped(_found(*equal, severity=Severity.ERROR))) == 1


def test_other_file_is_named_with_the_line() -> None:
    diagnostics = _found(("link 'a' is bare", 1))
    diagnostics.extend(_found(("link 'b' is bare", 2), ("link 'c' is bare", 3), file="x/arm.xacro"))
    (only,) = grouped(diagnostics)
    assert only.message.endswith("'b' (arm.xacro:2), 'c' (arm.xacro:3)")


def test_long_lists_end_with_a_count() -> None:
    words = [(f"link 'l{index}' is bare", index + 1) for index in range(20)]
    (only,) = grouped(_found(*words))
    assert only.message.count("(line") == 8
    assert only.message.endswith(" and 11 more")


def test_counts_of_a_file_do_not_keep_findings_apart() -> None:
    words = [
        ("<slip> in <ode> is not simulated (and 53 more in this file)", 1),
        ("<camera> in <gui> is not simulated", 2),
        ("<sky> in <scene> is not simulated", 3),
    ]
    (only,) = grouped(_found(*words))
    assert "<camera> (line 2), <sky> (line 3)" in only.message


def test_lines_after_the_first_stay_with_the_finding() -> None:
    words = [(f"'{name}' not found\n  looked in:\n    /{name}", 1) for name in "abc"]
    (only,) = grouped(_found(*words))
    assert only.message.startswith("'a' not found\n  looked in:\n    /a\n  the same 2 more times")


def test_files_of_one_name_are_told_apart_by_their_folders() -> None:
    diagnostics = _found(("no build file", 2), file="/ws/a/package.xml")
    for folder in "bc":
        diagnostics.extend(_found(("no build file", 2), file=f"/ws/{folder}/package.xml"))
    (only,) = grouped(diagnostics)
    assert only.message.endswith("the same 2 more times: b/package.xml:2, c/package.xml:2")


def test_files_are_named_where_no_line_is_known() -> None:
    diagnostics = _found(("no rules", 0), file="/ws/a/CMakeLists.txt")
    for folder in "bc":
        diagnostics.extend(_found(("no rules", 0), file=f"/ws/{folder}/CMakeLists.txt"))
    (only,) = grouped(diagnostics)
    assert only.message.endswith("more times: b/CMakeLists.txt, c/CMakeLists.txt")


def test_more_places_are_listed_where_more_are_asked_for() -> None:
    words = [(f"link 'l{index}' is bare", index + 1) for index in range(20)]
    (only,) = grouped(_found(*words), most=100)
    assert only.message.count("(line") == 19
