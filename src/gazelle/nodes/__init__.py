"""Built-in nodes under the names that launch files use: ``(package, type)`` → function."""
