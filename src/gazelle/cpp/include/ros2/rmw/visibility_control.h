#pragma once

#define RMW_PUBLIC __attribute__((visibility("default")))
#define RMW_LOCAL __attribute__((visibility("hidden")))
