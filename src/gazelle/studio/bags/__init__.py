"""Recording and playing bags from the page."""
