// Primitive types that a message may hold, as roscpp's traits see them.
#pragma once

#include <cstdint>

#include <ros/message_traits.h>
#include <ros/time.h>

namespace ros {
namespace message_traits {

#define GAZELLE_PRIMITIVE(Type)               \
  template <>                                 \
  struct IsSimple<Type> : public TrueType {}; \
  template <>                                 \
  struct IsFixedSize<Type> : public TrueType {};

GAZELLE_PRIMITIVE(uint8_t)
GAZELLE_PRIMITIVE(int8_t)
GAZELLE_PRIMITIVE(uint16_t)
GAZELLE_PRIMITIVE(int16_t)
GAZELLE_PRIMITIVE(uint32_t)
GAZELLE_PRIMITIVE(int32_t)
GAZELLE_PRIMITIVE(uint64_t)
GAZELLE_PRIMITIVE(int64_t)
GAZELLE_PRIMITIVE(float)
GAZELLE_PRIMITIVE(double)
GAZELLE_PRIMITIVE(Time)
GAZELLE_PRIMITIVE(Duration)
#undef GAZELLE_PRIMITIVE

// A bool's size in memory is the compiler's own.
template <>
struct IsFixedSize<bool> : public TrueType {};

}  // namespace message_traits
}  // namespace ros
