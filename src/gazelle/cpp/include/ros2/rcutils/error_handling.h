#pragma once

#include <stdbool.h>
#include <stdio.h>

#include "rcutils/allocator.h"
#include "rcutils/visibility_control.h"

#define RCUTILS_ERROR_MESSAGE_MAX_LENGTH 1024

/// The text of the last error, by value, so that it outlives the next one.
typedef struct rcutils_error_string_s {
  char str[RCUTILS_ERROR_MESSAGE_MAX_LENGTH];
} rcutils_error_string_t;

#ifdef __cplusplus
extern "C" {
#endif
RCUTILS_PUBLIC rcutils_error_string_t rcutils_get_error_string(void);
RCUTILS_PUBLIC bool rcutils_error_is_set(void);
RCUTILS_PUBLIC void rcutils_reset_error(void);
RCUTILS_PUBLIC void rcutils_set_error_state(const char* text, const char* file, size_t line);
#ifdef __cplusplus
}
#endif

#define RCUTILS_SET_ERROR_MSG(text) rcutils_set_error_state(text, __FILE__, __LINE__)
#define RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING(...)                      \
  do {                                                                     \
    char gazelle_error_text[RCUTILS_ERROR_MESSAGE_MAX_LENGTH];             \
    snprintf(gazelle_error_text, sizeof(gazelle_error_text), __VA_ARGS__); \
    RCUTILS_SET_ERROR_MSG(gazelle_error_text);                             \
  } while (0)
#define RCUTILS_SAFE_FWRITE_TO_STDERR(text) fputs((text), stderr)
#define RCUTILS_CHECK_ARGUMENT_FOR_NULL(argument, result)   \
  do {                                                      \
    if (!(argument)) {                                      \
      RCUTILS_SET_ERROR_MSG(#argument " argument is null"); \
      return result;                                        \
    }                                                       \
  } while (0)
#define RCUTILS_CHECK_FOR_NULL_WITH_MSG(value, text, result) \
  do {                                                       \
    if (!(value)) {                                          \
      RCUTILS_SET_ERROR_MSG(text);                           \
      return result;                                         \
    }                                                        \
  } while (0)
