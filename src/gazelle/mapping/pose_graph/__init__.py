"""Graphs of poses: edges and least squares."""
