"""What drop-in modules of navigation are made of."""
