"""Messages → what the page draws."""
