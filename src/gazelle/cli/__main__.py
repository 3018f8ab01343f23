"""``python -m gazelle.cli COMMAND…``, which the ROS-named commands of `gazelle env` call."""

from __future__ import annotations

import sys

from gazelle.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
