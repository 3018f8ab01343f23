#pragma once

#include <rosidl_runtime_cpp/traits.hpp>
