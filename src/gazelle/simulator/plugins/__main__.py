"""Prints ``docs/plugins.md``: ``python -m gazelle.simulator.plugins``."""

from __future__ import annotations

import sys

from gazelle.simulator.plugins.registry import all_tables
from gazelle.simulator.plugins.table import tables_as_markdown

if __name__ == "__main__":
    sys.stdout.write(tables_as_markdown(all_tables()))
