"""launch_param_builder.utils, by Gazelle."""

from gazelle.compat.moveit_configs.parameter_files import (
    ParameterBuilderFileNotFoundError,
    ParameterValueType,
    get_path,
    load_file,
    load_xacro,
    load_yaml,
    raise_if_file_not_found,
    render_template,
)
