#pragma once

#include <chrono>
#include <stdexcept>

namespace rcpputils {

/// Turn a duration into nanoseconds; throws where 64 bits do not hold them.
template <typename Rep, typename Period>
std::chrono::nanoseconds convert_to_nanoseconds(const std::chrono::duration<Rep, Period>& time) {
  constexpr auto most = std::chrono::duration<long double, std::nano>(
      static_cast<long double>(std::chrono::nanoseconds::max().count()));
  const auto exact = std::chrono::duration<long double, std::nano>(time);
  if (exact > most || exact < -most) {
    throw std::invalid_argument(
        "Casting nanoseconds duration must be less than maximum allowable value");
  }
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time);
}

}  // namespace rcpputils
