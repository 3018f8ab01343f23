"""Trajectories of joints: reading, splines, replacement, tolerances; no topics, no hardware."""
