"""Nodes that make scans of pictures and clouds, clean scans, and turn wrenches."""
