"""Robot files that a person has dropped on the page, to be looked at without a world."""
