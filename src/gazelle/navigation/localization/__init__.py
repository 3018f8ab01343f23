"""Monte Carlo localisation in a known map, as amcl does it."""

from __future__ import annotations

from gazelle.navigation.localization.amcl import Amcl, Estimate
from gazelle.navigation.localization.amcl_parameters import AmclOptions
from gazelle.navigation.localization.motion_model import MOTION_MODELS, moved

__all__ = ["MOTION_MODELS", "Amcl", "AmclOptions", "Estimate", "moved"]
