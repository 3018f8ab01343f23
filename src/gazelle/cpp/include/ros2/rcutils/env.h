#pragma once

#include <stdbool.h>
#include <stdlib.h>

#include "rcutils/macros.h"

/// Read a variable of the environment; an empty text where it is not set. NULL is success.
static inline const char* rcutils_get_env(const char* name, const char** value) {
  if (!name) return "argument env_name is null";
  if (!value) return "argument env_value is null";
  const char* found = getenv(name);
  *value = found ? found : "";
  return NULL;
}

static inline bool rcutils_set_env(const char* name, const char* value) {
  return value ? setenv(name, value, 1) == 0 : unsetenv(name) == 0;
}

static inline const char* rcutils_get_home_dir(void) {
  const char* home = getenv("HOME");
  return home && *home ? home : NULL;
}
