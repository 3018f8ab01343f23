#pragma once

namespace rosidl_runtime_cpp {

// How a message begins. Ours always begin with their defaults, zero where there are none.
enum class MessageInitialization { ALL = 0, SKIP = 1, ZERO = 2, DEFAULTS_ONLY = 3 };

}  // namespace rosidl_runtime_cpp
