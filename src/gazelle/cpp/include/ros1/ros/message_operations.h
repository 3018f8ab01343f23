#pragma once

#include <ostream>
#include <string>
#include <type_traits>

#include <gazelle/message.hpp>

namespace ros {
namespace message_operations {

// Prints a value as roscpp's operator<< does: a line for each field. Users may specialise it.
template <typename M>
struct Printer {
  template <typename Stream>
  static void stream(Stream& stream, const std::string& indent, const M& value) {
    if constexpr (::gazelle::is_message_v<M>) {
      ::gazelle::print_ros1(stream, ::gazelle::Description<M>::layout(), &value, indent);
    } else if constexpr (std::is_same<M, signed char>::value ||
                         std::is_same<M, unsigned char>::value) {
      stream << static_cast<int>(value) << "\n";
    } else {
      static_cast<void>(indent);
      stream << value << "\n";
    }
  }
};

}  // namespace message_operations
}  // namespace ros
