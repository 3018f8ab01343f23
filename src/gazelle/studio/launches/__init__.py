"""Launches of this machine: what they say of the user's files, which were run last, demos."""
