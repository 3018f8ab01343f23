#pragma once

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "rcutils/allocator.h"
#include "rcutils/strdup.h"

static inline bool rcutils_get_cwd(char* buffer, size_t size) {
  return buffer && getcwd(buffer, size) != NULL;
}

static inline bool rcutils_is_directory(const char* path) {
  struct stat found;
  return stat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

static inline bool rcutils_is_file(const char* path) {
  struct stat found;
  return stat(path, &found) == 0 && S_ISREG(found.st_mode);
}

static inline bool rcutils_exists(const char* path) {
  struct stat found;
  return stat(path, &found) == 0;
}

static inline bool rcutils_is_readable(const char* path) { return access(path, R_OK) == 0; }

static inline bool rcutils_mkdir(const char* path) {
  return mkdir(path, 0775) == 0 || rcutils_is_directory(path);
}

static inline size_t rcutils_get_file_size(const char* path) {
  struct stat found;
  return stat(path, &found) == 0 ? (size_t)found.st_size : 0;
}

static inline char* rcutils_join_path(const char* left, const char* right,
                                      rcutils_allocator_t allocator) {
  if (!left || !right) return NULL;
  size_t size = strlen(left) + strlen(right) + 2;
  char* joined = (char*)allocator.allocate(size, allocator.state);
  if (joined) snprintf(joined, size, "%s/%s", left, right);
  return joined;
}
