"""Recognising places: candidates, search, consistency."""
