"""The running world as the page sees and changes it."""
