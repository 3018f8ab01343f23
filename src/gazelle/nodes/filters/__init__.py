"""Nodes that make scans of pictures and clouds, and that clean scans."""
