"""moveit.utils: parameters as the file that MoveItPy reads."""

import tempfile

import yaml


def create_params_file_from_dict(params, node_name):
    """Write parameters of a node and return the file's path."""
    with tempfile.NamedTemporaryFile("w", suffix=".yaml", delete=False) as file:
        yaml.safe_dump({node_name: {"ros__parameters": params}}, file)
    return file.name
