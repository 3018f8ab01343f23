"""Plug-ins of rqt in the user's packages, and how they become panels."""
