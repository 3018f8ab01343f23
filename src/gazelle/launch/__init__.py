"""Launch files: reading them, and starting and supervising what they name."""
