#pragma once

#include <string.h>

#include "rcutils/allocator.h"

static inline char* rcutils_strndup(const char* text, size_t length,
                                    rcutils_allocator_t allocator) {
  if (!text) return NULL;
  char* copy = (char*)allocator.allocate(length + 1, allocator.state);
  if (!copy) return NULL;
  memcpy(copy, text, length);
  copy[length] = '\0';
  return copy;
}

static inline char* rcutils_strdup(const char* text, rcutils_allocator_t allocator) {
  return text ? rcutils_strndup(text, strlen(text), allocator) : NULL;
}
