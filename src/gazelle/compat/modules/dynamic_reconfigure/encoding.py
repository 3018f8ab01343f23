"""dynamic_reconfigure.encoding: configurations and messages."""

from gazelle.compat.dynamic_reconfigure.encoding import (
    Config,
    decode_config,
    decode_description,
    encode_config,
    extract_params,
)

__all__ = ["Config", "decode_config", "decode_description", "encode_config", "extract_params"]
