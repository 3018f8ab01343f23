"""Drop-in for nav2_common."""
