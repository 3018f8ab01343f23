# ros2_control_cmake: warnings are the user's own wish, and symbols are visible anyway.

macro(set_compiler_options)
endmacro()

macro(export_windows_symbols)
endmacro()
