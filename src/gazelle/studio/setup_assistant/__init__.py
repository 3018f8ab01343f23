"""The panel Setup Assistant: MoveIt config packages made and changed from the page."""
