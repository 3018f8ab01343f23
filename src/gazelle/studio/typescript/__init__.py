"""What the page takes from Python, as TypeScript: the rows of displays, the types of messages."""
