"""The comparison that tests of SDF texts rely on."""

from __future__ import annotations

from .comparing import differences


def test_order_of_siblings_and_spelling_of_numbers_do_not_count() -> None:
    ours = "<sdf><a name='x'><v>1 2.0</v></a><b/><a name='y'/></sdf>"
    theirs = "<sdf><b></b><a name='y'/><a name='x'><v>1.0  2</v></a></sdf>"
    assert differences(ours, theirs) == []


def test_each_difference_is_named_with_its_path() -> None:
    ours = "<sdf><a name='x' t='1'><v>1</v></a><c/></sdf>"
    theirs = "<sdf><a name='x'><v>1.1</v></a><b/></sdf>"
    assert differences(ours, theirs) == [
        "/sdf/a[x]: has t='1' too much",
        "/sdf/a[x]/v: text '1' instead of '1.1'",
        "/sdf/b: is missing: <b/>",
        "/sdf/c: is too much: <c/>",
    ]


def test_one_of_two_equal_siblings_missing_is_told() -> None:
    assert differences("<s><l/></s>", "<s><l/><l/></s>") == ["/s/l: is missing: <l/>"]


def test_numbers_differ_beyond_the_tolerance() -> None:
    assert differences("<s>1.00000001</s>", "<s>1</s>") == ["/s: text '1.00000001' instead of '1'"]
    assert differences("<s>1.0000000001</s>", "<s>1</s>") == []
