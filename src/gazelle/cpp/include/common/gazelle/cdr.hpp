// Messages as CDR (little endian, with its four bytes of header): what travels on the graph.
#pragma once

#include <gazelle/message.hpp>

namespace gazelle {

// Replaces what is in `cdr`. Throws Error where a value does not fit its field.
template <class M>
void to_cdr(const M& message, std::vector<std::uint8_t>& cdr) {
  message_type<M>().encode(&message, cdr);
}

// Throws Error where the bytes are not of this type; the message is then half read.
template <class M>
void from_cdr(M& message, const std::uint8_t* cdr, std::size_t size) {
  decode_cdr(Description<M>::layout(), &message, cdr, size);
}

template <class M>
void from_cdr(M& message, const std::vector<std::uint8_t>& cdr) {
  from_cdr(message, cdr.data(), cdr.size());
}

}  // namespace gazelle
