#pragma once

#include <stdarg.h>
#include <stdio.h>

#include "rcutils/macros.h"

RCUTILS_ATTRIBUTE_PRINTF_FORMAT(3, 4)
static inline int rcutils_snprintf(char* buffer, size_t size, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(buffer, size, format, arguments);
  va_end(arguments);
  return length;
}

RCUTILS_ATTRIBUTE_PRINTF_FORMAT(3, 0)
static inline int rcutils_vsnprintf(char* buffer, size_t size, const char* format,
                                    va_list arguments) {
  return vsnprintf(buffer, size, format, arguments);
}
