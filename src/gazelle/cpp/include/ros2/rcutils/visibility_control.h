#pragma once

#include "rcutils/macros.h"

#define RCUTILS_PUBLIC __attribute__((visibility("default")))
#define RCUTILS_LOCAL __attribute__((visibility("hidden")))
