// What a message class is: names, sums, and where its fields lie.
//
// Every generated message class specialises `Description`. The bytes are made of the table that
// `Description<M>::layout()` gives, by functions that are compiled once, in the core library: a
// program that uses a message compiles next to nothing for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include <gazelle/error.hpp>
#include <gazelle/message_type.hpp>

namespace gazelle {

// Specialised for every message and service class, of either generation. A message has
//   static constexpr const char *type        "std_msgs/msg/String"
//   static constexpr const char *ros1_type   "std_msgs/String"
//   static constexpr const char *md5, *hash  ROS 1's sum, and ROS 2's ("RIHS01_…")
//   static const Layout &layout();
//   static const char *definition();         the text with those of all messages inside
//   template <class Message, class Visitor> static void fields(Message &, Visitor &&);
//       calls visitor("name", member) for each field, in order
// and a service `type`, `ros1_type`, `md5`, `hash`, `Request` and `Response`.
template <class M>
struct Description;

// Of a request or response: `type` is the service's class.
template <class M>
struct ServiceOf;

// Of an action of ROS 2: `type`.
template <class A>
struct ActionDescription;

// Whether `Description<M>` is there.
namespace detail {
template <class M, class = void>
struct IsDescribed : std::false_type {};
template <class M>
struct IsDescribed<M, std::void_t<decltype(sizeof(Description<M>))>> : std::true_type {};
template <class M, class = void>
struct IsMessage : std::false_type {};
template <class M>
struct IsMessage<M, std::void_t<decltype(Description<M>::has_header)>> : std::true_type {};
template <class M, class = void>
struct IsService : std::false_type {};
template <class M>
struct IsService<M, std::void_t<typename Description<M>::Request>> : std::true_type {};
}  // namespace detail
template <class M>
inline constexpr bool is_message_v = detail::IsMessage<M>::value;
template <class S>
inline constexpr bool is_service_v = detail::IsService<S>::value;

// What a member holds. Times are two 32-bit words, seconds and nanoseconds.
enum class Kind : std::uint8_t {
  boolean,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
  byte,  // an unsigned number that texts show as 0x0f
  string,
  wstring,
  time,
  duration,
  message,
  wide_on_wire,  // a std::string here, a wide string on the graph
  log_level      // ROS 1's level of a log message, ROS 2's on the graph
};

enum class Repeat : std::uint8_t { one, fixed, sequence };

struct Layout;

// How the codec reaches the elements of a std::vector of messages.
struct Sequence {
  std::size_t (*size)(const void* vector);
  void (*resize)(void* vector, std::size_t size);
  void* (*data)(void* vector);
  std::size_t element;  // bytes of one element
};

inline constexpr std::uint32_t absent = 0xffffffffu;  // the class has no such member

struct Member {
  const char* name = "";
  std::uint32_t offset = 0;  // `absent`: written as its default, read and forgotten
  Kind kind = Kind::uint8;
  Repeat repeat = Repeat::one;
  std::uint32_t size = 0;              // length of a fixed array, bound of a sequence (0: none)
  std::uint32_t string_bound = 0;      // 0: none
  const Layout& (*child)() = nullptr;  // of a message
  const Sequence& (*sequence)() = nullptr;  // of a sequence of messages
  std::uint64_t bits = 0;                   // default of an absent number, as it is in memory
  const char* text = nullptr;               // default of an absent string
};

// A message class, or one that is only on the wire (`bytes` is 0 then).
struct Layout {
  const char* type;
  const char* ros1_type;
  const char* md5;
  const char* hash;
  const char* text;  // the definition of this message alone
  bool is_ros1;
  std::uint32_t bytes;
  const Member* members;  // in the class's own order, which is ROS 1's wire and the one of texts
  std::uint32_t count;
  const Member* cdr_members;  // in the order of CDR
  std::uint32_t cdr_count;
};

// The definition of a message and, behind rules, of all that it contains; kept for good.
const char* full_definition(const Layout& layout);

void encode_cdr(const Layout& layout, const void* message, std::vector<std::uint8_t>& cdr);
void decode_cdr(const Layout& layout, void* message, const std::uint8_t* cdr, std::size_t size);
void encode_ros1(const Layout& layout, const void* message, std::vector<std::uint8_t>& bytes);
std::size_t ros1_size(const Layout& layout, const void* message);
// Writes into `bytes`, which holds `size`; throws where that is too little. Returns what it took.
std::size_t encode_ros1(const Layout& layout, const void* message, std::uint8_t* bytes,
                        std::size_t size);
std::size_t decode_ros1(const Layout& layout, void* message, const std::uint8_t* bytes,
                        std::size_t size);

// As `rostopic echo` of ROS 1's C++ and `ros2 topic echo` print them.
void print_ros1(std::ostream& stream, const Layout& layout, const void* message,
                const std::string& indent = "");
void print_yaml(std::ostream& stream, const Layout& layout, const void* message,
                std::size_t indentation, bool flow_style);

namespace detail {
template <class T>
struct SequenceOf {
  static std::size_t size(const void* vector) {
    return static_cast<const std::vector<T>*>(vector)->size();
  }
  static void resize(void* vector, std::size_t size) {
    static_cast<std::vector<T>*>(vector)->resize(size);
  }
  static void* data(void* vector) { return static_cast<std::vector<T>*>(vector)->data(); }
  static const Sequence& table() {
    static const Sequence found{&size, &resize, &data, sizeof(T)};
    return found;
  }
};
}  // namespace detail

namespace detail {
template <class M>
struct TypeOf {
  static void encode(const void* message, std::vector<std::uint8_t>& cdr) {
    encode_cdr(Description<M>::layout(), message, cdr);
  }
  static std::shared_ptr<void> create() { return std::make_shared<M>(); }
  static std::shared_ptr<void> decode(const std::uint8_t* cdr, std::size_t size) {
    auto made = std::make_shared<M>();
    decode_cdr(Description<M>::layout(), made.get(), cdr, size);
    return made;
  }
  static const MessageType& get() {
    static const MessageType found{Description<M>::type,
                                   Description<M>::ros1_type,
                                   Description<M>::md5,
                                   Description<M>::hash,
                                   &Description<M>::definition,
                                   &typeid(M),
                                   Description<M>::layout().is_ros1,
                                   &encode,
                                   &decode,
                                   &create,
                                   &Description<M>::layout()};
    return found;
  }
};
}  // namespace detail

// May be specialised for classes that describe themselves otherwise, by `detail::TypeOf`.
template <class M>
const MessageType& message_type() {
  return detail::TypeOf<std::remove_cv_t<M>>::get();
}

template <class S>
const ServiceType& service_type() {
  using Of = Description<std::remove_cv_t<S>>;
  static const ServiceType found{Of::type,
                                 Of::ros1_type,
                                 Of::md5,
                                 Of::hash,
                                 &message_type<typename Of::Request>(),
                                 &message_type<typename Of::Response>()};
  return found;
}

}  // namespace gazelle
