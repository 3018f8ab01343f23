"""From an expanded text, whatever process expanded it, back to the lines of the xacro files.

Every run of xacro keeps where its elements come from in the user's cache folder. Whoever gets the
text later, as a parameter or from a file, finds the places again by the text's elements, so
comments, white space and the order of attributes do not matter.
"""

from __future__ import annotations

from gazelle.description.source_maps.store import SourceMap, placed, remember, source_map_of

__all__ = ["SourceMap", "placed", "remember", "source_map_of"]
