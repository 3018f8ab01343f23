// What other libraries may use: ours are compiled with hidden names.
#pragma once

#define GAZELLE_EXPORT __attribute__((visibility("default")))
