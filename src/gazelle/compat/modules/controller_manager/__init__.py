"""Drop-in for controller_manager."""
