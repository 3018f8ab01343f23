"""Loads, configures, starts and stops controllers."""
