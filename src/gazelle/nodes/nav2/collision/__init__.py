"""Zones around a robot, what sensors see in them, and what that does to commands."""
