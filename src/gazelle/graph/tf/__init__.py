"""Coordinate frames over time: buffer, listener and broadcasters."""
