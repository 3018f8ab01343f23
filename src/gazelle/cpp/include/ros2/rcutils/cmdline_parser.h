#pragma once

#include <stdbool.h>
#include <string.h>

#include "rcutils/visibility_control.h"

/// Tell whether a word is among those from `begin` to before `end`.
static inline bool rcutils_cli_option_exist(char** begin, char** end, const char* option) {
  for (char** word = begin; word != end; ++word) {
    if (*word && strcmp(*word, option) == 0) return true;
  }
  return false;
}

/// Return the word after an option, NULL where there is none.
static inline char* rcutils_cli_get_option(char** begin, char** end, const char* option) {
  for (char** word = begin; word != end; ++word) {
    if (*word && strcmp(*word, option) == 0) return word + 1 != end ? word[1] : NULL;
  }
  return NULL;
}
