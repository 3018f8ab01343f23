#pragma once

#include "rcutils/error_handling.h"

typedef rcutils_error_string_t rcl_error_string_t;

#define rcl_get_error_string rcutils_get_error_string
#define rcl_error_is_set rcutils_error_is_set
#define rcl_reset_error rcutils_reset_error
#define RCL_SET_ERROR_MSG(text) RCUTILS_SET_ERROR_MSG(text)
