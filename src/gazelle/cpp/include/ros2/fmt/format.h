// fmt where the system has it, else enough of it for texts with braces.
#pragma once

#if __has_include_next(<fmt/format.h>)
#include_next <fmt/format.h>
#else
#include <gazelle/format.hpp>
#endif
