"""Packages and interfaces as users' programs ask for them."""
