"""What the C library does with memory that is free again."""

from __future__ import annotations

import platform
import subprocess
import sys

import pytest

from gazelle.graph.glibc_malloc import keep_freed_memory

_FREED_AFTER_LARGER_ONES = """
import sys
import psutil
from gazelle.graph.glibc_malloc import return_large_blocks

def held_mb():
    # From the largest to the smallest, so that none fits where another one was.
    blocks = [bytearray(largest - 64 * number) for number in range(60_000_000 // largest)]
    full = psutil.Process().memory_info().rss
    # Small blocks between them and the end of the heap.
    small = [bytes(5_000) for _ in range(200)]
    del blocks
    return (full - psutil.Process().memory_info().rss) / 1e6

largest = int(sys.argv[1])
held_mb()
return_large_blocks()
print(held_mb())
"""

_FULL_OF_HOLES = """
import psutil
from gazelle.graph.glibc_malloc import HeapTrim

blocks = [bytearray(60_000) for _ in range(1_000)]
kept = blocks[::10]
del blocks
trim, held = HeapTrim(), []
for _ in range(2):
    held.append(psutil.Process().memory_info().rss / 1e6)
    # A picture of 4 MiB; small messages do not count.
    for _ in range(4):
        trim.took(4 << 20)
    trim.took(1_000)
held.append(psutil.Process().memory_info().rss / 1e6)
print(held[0] - held[1], held[1] - held[2])
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks glibc")
def test_holes_of_a_heap_go_back_to_the_system_after_many_large_messages() -> None:
    words = [sys.executable, "-c", _FULL_OF_HOLES]
    ended = subprocess.run(words, capture_output=True, text=True, check=True)
    after_half, after_all = map(float, ended.stdout.split())
    # 54 MB of holes.
    assert after_half < 1.0 and after_all > 45.0


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks glibc")
@pytest.mark.parametrize("largest", [900_000, 230_400])
def test_large_blocks_go_back_to_the_system(largest: int) -> None:
    words = [sys.executable, "-c", _FREED_AFTER_LARGER_ONES, str(largest)]
    ended = subprocess.run(words, capture_output=True, text=True, check=True)
    # 52 and 58 MB of blocks.
    assert float(ended.stdout) > 45.0


def test_glibc_alone_can_be_told_to_keep_memory() -> None:
    is_glibc = sys.platform == "linux" and platform.libc_ver()[0] == "glibc"
    assert keep_freed_memory() is is_glibc
