// The names that generate_parameter_library's validators had before they were rsl's.
#pragma once

#include <rsl/parameter_validators.hpp>
#include <rsl/static_string.hpp>
#include <rsl/static_vector.hpp>

namespace parameter_traits {

using namespace rsl;

using Result = tl::expected<void, std::string>;

template <std::size_t capacity>
using FixedSizeString = rsl::StaticString<capacity>;
template <class T, std::size_t capacity>
using FixedSizeArray = rsl::StaticVector<T, capacity>;

}  // namespace parameter_traits
