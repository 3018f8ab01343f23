#pragma once

#define RCPPUTILS_PUBLIC __attribute__((visibility("default")))
#define RCPPUTILS_LOCAL __attribute__((visibility("hidden")))
