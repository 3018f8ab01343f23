#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

#include "rcutils/macros.h"
#include "rcutils/types/rcutils_ret.h"

/// How C code gets memory: functions and a state that they are given.
typedef struct rcutils_allocator_s {
  void* (*allocate)(size_t size, void* state);
  void (*deallocate)(void* pointer, void* state);
  void* (*reallocate)(void* pointer, size_t size, void* state);
  void* (*zero_allocate)(size_t number_of_elements, size_t size_of_element, void* state);
  void* state;
} rcutils_allocator_t;

static inline void* gazelle_rcutils_allocate(size_t size, void* state) {
  (void)state;
  return malloc(size);
}

static inline void gazelle_rcutils_deallocate(void* pointer, void* state) {
  (void)state;
  free(pointer);
}

static inline void* gazelle_rcutils_reallocate(void* pointer, size_t size, void* state) {
  (void)state;
  return realloc(pointer, size);
}

static inline void* gazelle_rcutils_zero_allocate(size_t number, size_t size, void* state) {
  (void)state;
  return calloc(number, size);
}

static inline rcutils_allocator_t rcutils_get_zero_initialized_allocator(void) {
  rcutils_allocator_t allocator = {NULL, NULL, NULL, NULL, NULL};
  return allocator;
}

static inline rcutils_allocator_t rcutils_get_default_allocator(void) {
  rcutils_allocator_t allocator = {gazelle_rcutils_allocate, gazelle_rcutils_deallocate,
                                   gazelle_rcutils_reallocate, gazelle_rcutils_zero_allocate, NULL};
  return allocator;
}

static inline bool rcutils_allocator_is_valid(const rcutils_allocator_t* allocator) {
  return allocator && allocator->allocate && allocator->deallocate && allocator->reallocate &&
         allocator->zero_allocate;
}
