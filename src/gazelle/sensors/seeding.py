"""Random streams of sensors: each of its own, from the world's seed and a scoped name."""

from __future__ import annotations

import hashlib

import numpy as np

__all__ = ["random_stream", "seed_words"]


def random_stream(seed: int, name: str) -> np.random.Generator:
    """Return a stream of random numbers that depends on nothing else, threads and order included.

    Args:
        seed: of the world.
        name: scoped name of the sensor or plug-in, and of the axis where it has several noises.
    """
    return np.random.Generator(np.random.Philox(np.random.SeedSequence(seed_words(seed, name))))


def seed_words(seed: int, name: str) -> list[int]:
    """Return the words that seed a stream: the same in every process and version."""
    digest = hashlib.blake2b(f"{seed}\0{name}".encode(), digest_size=32).digest()
    return [int(word) for word in np.frombuffer(digest, "<u4")]
