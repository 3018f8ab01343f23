#pragma once

#define RCUTILS_WARN_UNUSED __attribute__((warn_unused_result))
#define RCUTILS_ATTRIBUTE_PRINTF_FORMAT(format_index, arguments_index) \
  __attribute__((format(printf, format_index, arguments_index)))
#ifndef RCUTILS_THREAD_LOCAL
#ifdef __cplusplus
#define RCUTILS_THREAD_LOCAL thread_local
#else
#define RCUTILS_THREAD_LOCAL _Thread_local
#endif
#endif
#define RCUTILS_STRINGIFY_IMPL(x) #x
#define RCUTILS_STRINGIFY(x) RCUTILS_STRINGIFY_IMPL(x)
#define RCUTILS_UNUSED(x) (void)(x)
#define RCUTILS_LIKELY(x) __builtin_expect((x), 1)
#define RCUTILS_UNLIKELY(x) __builtin_expect((x), 0)
#define RCUTILS_CAN_FAIL_WITH(...)
#define RCUTILS_CAN_RETURN_WITH_ERROR_OF(...)
