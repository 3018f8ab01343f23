"""Driving from the keyboard: the terminal's keys, and ``teleop_twist_keyboard``."""
