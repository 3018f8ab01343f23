"""What notebooks show: records as pictures and plots, a simulation as a live page in the cell.

Records of all layers name their renderer here by text (`gazelle.rich_display`). Renderers are
functions from a record to a bundle of MIME types: bounded in size, without scripts from
elsewhere, legible on light and dark pages.
"""
