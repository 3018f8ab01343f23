#pragma once

#include <stdint.h>
#include <string.h>

#include "rcutils/allocator.h"

/// Bytes that grow: what a serialized message is in C.
typedef struct rcutils_uint8_array_s {
  uint8_t* buffer;
  size_t buffer_length;
  size_t buffer_capacity;
  rcutils_allocator_t allocator;
} rcutils_uint8_array_t;

static inline rcutils_uint8_array_t rcutils_get_zero_initialized_uint8_array(void) {
  rcutils_uint8_array_t array = {NULL, 0, 0, {NULL, NULL, NULL, NULL, NULL}};
  return array;
}

static inline rcutils_ret_t rcutils_uint8_array_init(rcutils_uint8_array_t* array, size_t capacity,
                                                     const rcutils_allocator_t* allocator) {
  if (!array || !allocator) return RCUTILS_RET_INVALID_ARGUMENT;
  array->allocator = *allocator;
  array->buffer_length = 0;
  array->buffer_capacity = capacity;
  array->buffer = NULL;
  if (capacity) {
    array->buffer = (uint8_t*)allocator->allocate(capacity, allocator->state);
    if (!array->buffer) return RCUTILS_RET_BAD_ALLOC;
  }
  return RCUTILS_RET_OK;
}

static inline rcutils_ret_t rcutils_uint8_array_fini(rcutils_uint8_array_t* array) {
  if (!array) return RCUTILS_RET_INVALID_ARGUMENT;
  if (array->buffer) array->allocator.deallocate(array->buffer, array->allocator.state);
  array->buffer = NULL;
  array->buffer_length = 0;
  array->buffer_capacity = 0;
  return RCUTILS_RET_OK;
}

static inline rcutils_ret_t rcutils_uint8_array_resize(rcutils_uint8_array_t* array, size_t size) {
  if (!array || size == 0) return RCUTILS_RET_INVALID_ARGUMENT;
  if (size != array->buffer_capacity) {
    uint8_t* grown =
        (uint8_t*)array->allocator.reallocate(array->buffer, size, array->allocator.state);
    if (!grown) return RCUTILS_RET_BAD_ALLOC;
    array->buffer = grown;
    array->buffer_capacity = size;
    if (array->buffer_length > size) array->buffer_length = size;
  }
  return RCUTILS_RET_OK;
}
