"""Prints ``docs/plugins.md``: ``python -m gazelle.simulator.plugins``."""

from __future__ import annotations

import sys

from gazelle.simulator.plugins.plugin_parameters import tables_as_markdown
from gazelle.simulator.plugins.registry import all_tables

if __name__ == "__main__":
    sys.stdout.write(tables_as_markdown(all_tables()))
