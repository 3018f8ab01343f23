#pragma once

#include <stddef.h>

#include "rcutils/allocator.h"

/// A list of texts in C.
typedef struct rcutils_string_array_s {
  size_t size;
  char** data;
  rcutils_allocator_t allocator;
} rcutils_string_array_t;

static inline rcutils_string_array_t rcutils_get_zero_initialized_string_array(void) {
  rcutils_string_array_t array = {0, NULL, {NULL, NULL, NULL, NULL, NULL}};
  return array;
}
