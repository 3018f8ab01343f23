"""dynamic_reconfigure.parameter_generator: what .cfg files are written with."""

from gazelle.compat.dynamic_reconfigure.parameter_generator import (
    ParameterGenerator,
    bool_t,
    double_t,
    int_t,
    str_t,
)

__all__ = ["ParameterGenerator", "bool_t", "double_t", "int_t", "str_t"]
