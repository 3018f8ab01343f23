#pragma once

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include "rcutils/allocator.h"
#include "rcutils/error_handling.h"
#include "rcutils/time.h"
#include "rcutils/visibility_control.h"

enum RCUTILS_LOG_SEVERITY {
  RCUTILS_LOG_SEVERITY_UNSET = 0,
  RCUTILS_LOG_SEVERITY_DEBUG = 10,
  RCUTILS_LOG_SEVERITY_INFO = 20,
  RCUTILS_LOG_SEVERITY_WARN = 30,
  RCUTILS_LOG_SEVERITY_ERROR = 40,
  RCUTILS_LOG_SEVERITY_FATAL = 50
};

#define RCUTILS_DEFAULT_LOGGER_DEFAULT_LEVEL RCUTILS_LOG_SEVERITY_INFO

typedef struct rcutils_log_location_s {
  const char* function_name;
  const char* file_name;
  size_t line_number;
} rcutils_log_location_t;

typedef void (*rcutils_logging_output_handler_t)(const rcutils_log_location_t* location,
                                                 int severity, const char* name,
                                                 rcutils_time_point_value_t timestamp,
                                                 const char* format, va_list* arguments);

#ifdef __cplusplus
extern "C" {
#endif
RCUTILS_PUBLIC rcutils_ret_t rcutils_logging_initialize(void);
RCUTILS_PUBLIC rcutils_ret_t rcutils_logging_shutdown(void);
RCUTILS_PUBLIC int rcutils_logging_get_default_logger_level(void);
RCUTILS_PUBLIC void rcutils_logging_set_default_logger_level(int level);
RCUTILS_PUBLIC int rcutils_logging_get_logger_level(const char* name);
RCUTILS_PUBLIC rcutils_ret_t rcutils_logging_set_logger_level(const char* name, int level);
RCUTILS_PUBLIC int rcutils_logging_get_logger_effective_level(const char* name);
RCUTILS_PUBLIC bool rcutils_logging_logger_is_enabled_for(const char* name, int severity);
RCUTILS_PUBLIC rcutils_ret_t rcutils_logging_severity_level_from_string(
    const char* text, rcutils_allocator_t allocator, int* severity);
RCUTILS_PUBLIC rcutils_logging_output_handler_t rcutils_logging_get_output_handler(void);
RCUTILS_PUBLIC void rcutils_logging_set_output_handler(rcutils_logging_output_handler_t handler);
RCUTILS_PUBLIC void rcutils_logging_console_output_handler(const rcutils_log_location_t* location,
                                                           int severity, const char* name,
                                                           rcutils_time_point_value_t timestamp,
                                                           const char* format, va_list* arguments);
RCUTILS_PUBLIC void rcutils_log(const rcutils_log_location_t* location, int severity,
                                const char* name, const char* format, ...)
    RCUTILS_ATTRIBUTE_PRINTF_FORMAT(4, 5);
#ifdef __cplusplus
}
#endif

#define RCUTILS_LOGGING_AUTOINIT rcutils_logging_initialize()
