// The last error of C functions, by thread; serializing by a type's handle.
#include <cstdio>
#include <cstring>
#include <string>

#include "gazelle/error.hpp"
#include "gazelle/message.hpp"
#include "rcutils/error_handling.h"
#include "rmw/rmw.h"

namespace {

rcutils_error_string_t& last_error() {
  thread_local rcutils_error_string_t text{};
  return text;
}

}  // namespace

extern "C" {

rcutils_error_string_t rcutils_get_error_string(void) {
  rcutils_error_string_t text = last_error();
  if (!text.str[0]) std::snprintf(text.str, sizeof(text.str), "error not set");
  return text;
}

bool rcutils_error_is_set(void) { return last_error().str[0] != '\0'; }
void rcutils_reset_error(void) { last_error().str[0] = '\0'; }

void rcutils_set_error_state(const char* text, const char* file, size_t line) {
  std::snprintf(last_error().str, sizeof(last_error().str), "%s, at %s:%zu", text ? text : "",
                file ? file : "", line);
}

const char* rmw_get_implementation_identifier(void) { return "rmw_gazelle_cpp"; }

}  // extern "C"
