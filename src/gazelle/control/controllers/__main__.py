"""``python -m gazelle.control.controllers`` prints ``docs/controllers.md``."""

from __future__ import annotations

import sys

from gazelle.control.controllers.docs_page import tables_as_markdown
from gazelle.control.controllers.registry import all_tables

if __name__ == "__main__":
    sys.stdout.write(tables_as_markdown(all_tables()))
