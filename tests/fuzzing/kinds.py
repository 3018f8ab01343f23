"""Everything that is damaged, by name: files and what comes over wires."""

from __future__ import annotations

from tests.fuzzing.bags import BAGS
from tests.fuzzing.descriptions import DESCRIPTIONS
from tests.fuzzing.kind import SCOUT, Kind
from tests.fuzzing.maps import MAPS
from tests.fuzzing.messages import MESSAGES
from tests.fuzzing.settings import SETTINGS
from tests.fuzzing.wires import WIRES

__all__ = ["KINDS", "SCOUT", "Kind"]

KINDS: dict[str, Kind] = dict(
    sorted((DESCRIPTIONS | BAGS | MESSAGES | MAPS | SETTINGS | WIRES).items())
)
