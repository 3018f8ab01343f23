"""moveit.utils: parameters as the file that MoveItPy reads."""

import tempfile

from gazelle.documents.yaml import dump_yaml


def create_params_file_from_dict(params, node_name):
    """Write parameters of a node and return the file's path."""
    with tempfile.NamedTemporaryFile("w", suffix=".yaml", delete=False) as file:
        file.write(dump_yaml({node_name: {"ros__parameters": params}}))
    return file.name
