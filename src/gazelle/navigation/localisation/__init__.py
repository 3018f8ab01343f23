"""Monte Carlo localisation in a known map, as amcl does it."""

from __future__ import annotations

from gazelle.navigation.localisation.filter import Amcl, Estimate
from gazelle.navigation.localisation.motion import MOTION_MODELS, moved
from gazelle.navigation.localisation.options import AmclOptions

__all__ = ["MOTION_MODELS", "Amcl", "AmclOptions", "Estimate", "moved"]
