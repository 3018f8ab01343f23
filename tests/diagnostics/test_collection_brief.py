"""What is said at a start: settings without effect in one line."""

from __future__ import annotations

from gazelle.diagnostics import Diagnostic, Diagnostics, SourceSpan, brief
from gazelle.diagnostics.catalogue import all_entries


def _found(*names: str) -> Diagnostics:
    found = Diagnostics()
    for line, name in enumerate(names, 1):
        text = f"parameter '{name}' has no effect here: why"
        found.report("parameter.idle", text, SourceSpan("nav.yaml", line))
    return found


def _texts(items: tuple[Diagnostic, ...]) -> list[str]:
    return [str(item) for item in items]


def test_several_settings_without_effect_become_one_line() -> None:
    found = _found("a", "b", "c")
    shown, idle = brief(found, "/tmp/node.log")
    assert _texts(shown) == [
        "nav.yaml:1: info: 3 settings are known and have no effect here; all of them: "
        "/tmp/node.log; the first: parameter 'a' has no effect here: why "
        "[parameter.idle]"
    ]
    assert idle == tuple(found)


def test_a_single_one_is_said_without_its_general_remedy() -> None:
    shown, idle = brief(_found("a"), "/tmp/node.log")
    assert _texts(shown) == [
        "nav.yaml:1: info: parameter 'a' has no effect here: why [parameter.idle]"
    ]
    assert idle == ()


def test_unknown_keys_and_errors_stay_whole_and_in_order() -> None:
    found = Diagnostics()
    found.report("parameter.bad-value", "x is 'a'", fix="write a number")
    found.extend(_found("a", "b"))
    found.report("parameter.unknown", "y is not known", fix="did you mean 'z'?")
    shown, _idle = brief(found)
    assert [item.code for item in shown] == [
        "parameter.bad-value", "parameter.idle", "parameter.unknown",
    ]  # fmt: skip
    assert shown[0].fix == "write a number"
    assert shown[2].fix == "did you mean 'z'?"
    assert shown[1].message.startswith("2 settings are known and have no effect here; the first: ")


def test_what_raises_its_severity_is_not_summed() -> None:
    found = Diagnostics()
    from gazelle.diagnostics import Severity

    for name in "ab":
        found.report("urdf.gazebo-no-effect", f"{name} is lost", severity=Severity.WARNING)
    assert brief(found).shown == tuple(found)


def test_what_works_and_asks_for_nothing_is_kept_and_not_said() -> None:
    found = Diagnostics()
    found.report("plugin.built-in", "plug-in 'a' is part of Gazelle")
    found.report("simulator.server-plugin", "server plug-in 'b' is part of Gazelle")
    found.report("plugin.unknown", "plug-in 'c' is compiled code")
    shown, kept = brief(found)
    assert [item.code for item in shown] == ["plugin.unknown"]
    assert [item.code for item in kept] == ["plugin.built-in", "simulator.server-plugin"]
    shown, kept = brief([*found, *_found("x", "y")])
    assert [item.code for item in shown] == ["plugin.unknown", "parameter.idle"]
    assert len(kept) == 4


def test_whatever_says_that_nothing_is_to_be_done_is_not_said() -> None:
    printed = {"xacro.message"}
    told = {
        entry.code
        for entry in all_entries().values()
        if entry.fix.startswith("nothing to do") and not (entry.quiet or entry.idle)
    }
    assert told == printed
