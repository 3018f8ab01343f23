"""Messages → what the page draws, display by display, with RViz's names and words."""
