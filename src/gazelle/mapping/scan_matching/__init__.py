"""Scan matching: likelihood fields, correlative search, refinement."""
