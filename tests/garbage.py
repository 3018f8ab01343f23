"""When Python looks for garbage while the tests run, as hooks of pytest.

Half a million objects of the tests themselves are there from their collection to the end, and each
thorough look for garbage would go over all of them: a fifth of all computing.
"""

from __future__ import annotations

import gc

from gazelle.process_lifetime import collect_garbage_rarely

__all__ = ["pytest_collection_finish", "pytest_configure"]


def pytest_configure() -> None:
    """Look for none while the tests are collected: it all stays."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Look from here on at what comes later only, and as rarely as a node does."""
    gc.collect()
    gc.freeze()
    collect_garbage_rarely()
    gc.enable()
