from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from gazelle.description.source_maps.alignment import aligned


def _keys(text: str) -> list[int]:
    """Make keys of letters: upper and lower case of one are elements of one name."""
    return [ord(letter.lower()) << 32 | ord(letter) for letter in text]


def _pairs(old: str, new: str) -> str:
    return " ".join(str(index) for index in aligned(_keys(old), _keys(new)))


def test_equal_texts_pair_one_to_one() -> None:
    assert _pairs("abab", "abab") == "0 1 2 3"


def test_removed_added_and_changed_elements() -> None:
    assert _pairs("abcdef", "abdef") == "0 1 3 4 5"
    assert _pairs("abcdef", "abcxdef") == "0 1 2 -1 3 4 5"
    assert _pairs("abcdef", "abCdef") == "0 1 2 3 4 5"
    assert _pairs("abcdef", "abxdef") == "0 1 -1 3 4 5"


def test_repeated_elements_pair_beside_unique_ones() -> None:
    assert _pairs("ollolloXoll", "ollollooll") == "0 1 2 3 4 5 6 8 9 10"


def test_nothing_in_common_pairs_nothing() -> None:
    assert _pairs("abc", "xyz") == "-1 -1 -1"
    assert _pairs("", "xy") == "-1 -1"


@given(st.text("abcdeABC", max_size=30), st.text("abcdeABC", max_size=30))
def test_pairs_rise_and_have_equal_names(old: str, new: str) -> None:
    pairs = aligned(_keys(old), _keys(new))
    used = [index for index in pairs if index >= 0]
    assert used == sorted(set(used))
    for index, other in enumerate(pairs):
        assert other < 0 or old[other].lower() == new[index].lower()
