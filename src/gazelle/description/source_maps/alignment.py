"""Which elements of a changed text are those of the text it was made from."""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Sequence

from gazelle.description.source_maps.record import name_part

__all__ = ["aligned"]


def aligned(old: Sequence[int], new: Sequence[int]) -> list[int]:
    """Pair the elements of two texts by their keys, in order.

    Elements that both texts have exactly once are the anchors, as in a patience diff. From each
    the equal neighbours are paired. Where the same number of elements lies between two pairs on
    both sides, those with equal names are paired too: they are what was changed.

    Returns:
        For each of `new` the index in `old`, or -1.
    """
    pairs = [-1] * len(new)
    for old_index, new_index in _anchors(old, new):
        pairs[new_index] = old_index
    _spread(old, new, pairs, 1)
    _spread(old, new, pairs, -1)
    _fill(old, new, pairs)
    return pairs


def _anchors(old: Sequence[int], new: Sequence[int]) -> list[tuple[int, int]]:
    """Return the longest rising chain of elements that stand once in both."""
    in_old, in_new = Counter(old), Counter(new)
    where = {key: index for index, key in enumerate(old) if in_old[key] == 1}
    found = [
        (where[key], index) for index, key in enumerate(new) if in_new[key] == 1 and key in where
    ]
    tails: list[int] = []
    ends: list[int] = []
    before: list[int] = []
    for index, (old_index, _) in enumerate(found):
        slot = bisect_left(tails, old_index)
        before.append(ends[slot - 1] if slot else -1)
        tails[slot:] = [old_index, *tails[slot + 1 :]]
        ends[slot:] = [index, *ends[slot + 1 :]]
    chain: list[tuple[int, int]] = []
    index = ends[-1] if ends else -1
    while index >= 0:
        chain.append(found[index])
        index = before[index]
    return chain


def _spread(old: Sequence[int], new: Sequence[int], pairs: list[int], step: int) -> None:
    """Pair equal neighbours behind (1) or before (-1) the pairs there are, and the texts' ends."""
    taken = set(pairs)
    order = range(len(new)) if step > 0 else range(len(new) - 1, -1, -1)
    last = -1 if step > 0 else len(old)
    for index in order:
        if pairs[index] >= 0:
            last = pairs[index]
            continue
        following = last + step
        if 0 <= following < len(old) and following not in taken and old[following] == new[index]:
            pairs[index] = last = following
            taken.add(following)


def _fill(old: Sequence[int], new: Sequence[int], pairs: list[int]) -> None:
    start = 0
    while start < len(new):
        if pairs[start] >= 0:
            start += 1
            continue
        end = start
        while end < len(new) and pairs[end] < 0:
            end += 1
        first = pairs[start - 1] + 1 if start else 0
        stop = pairs[end] if end < len(new) else len(old)
        if stop - first == end - start:
            for offset in range(end - start):
                if name_part(old[first + offset]) == name_part(new[start + offset]):
                    pairs[start + offset] = first + offset
        start = end
