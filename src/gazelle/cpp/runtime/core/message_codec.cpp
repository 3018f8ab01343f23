// Bytes of messages, by the tables of their classes: CDR as the graph carries it, and ROS 1's own.
//
// CDR: a header of four bytes, then every value at a multiple of its size counted from the header's
// end. ROS 1's wire has neither. Otherwise both are alike, so one writer and one reader do both.
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gazelle/message.hpp>

namespace gazelle {
namespace {

constexpr std::size_t header_size = 4;

std::size_t number_size(Kind kind) {
  switch (kind) {
    case Kind::boolean:
    case Kind::int8:
    case Kind::uint8:
    case Kind::byte:
    case Kind::log_level:
      return 1;
    case Kind::int16:
    case Kind::uint16:
      return 2;
    case Kind::int32:
    case Kind::uint32:
    case Kind::float32:
    case Kind::time:
    case Kind::duration:
      return 4;
    case Kind::int64:
    case Kind::uint64:
    case Kind::float64:
      return 8;
    default:
      return 0;
  }
}

bool is_time(Kind kind) { return kind == Kind::time || kind == Kind::duration; }

[[noreturn]] void fail(const Layout& layout, const Member& member, const std::string& why) {
  throw Error(std::string(layout.type) + ": '" + member.name + "' " + why, "InterfaceError");
}

[[noreturn]] void cut_short(const Layout& layout, std::size_t size) {
  throw Error(std::to_string(size) + " bytes are not a " + layout.type +
                  ": the bytes end too early; the sender's definition may be another one "
                  "(ROS: md5sum mismatch, buffer overrun)",
              "InterfaceError");
}

// Levels of ROS 1's log messages are one bit each, those of ROS 2 tens.
std::uint8_t level_to_wire(std::uint8_t level) {
  switch (level) {
    case 1:
      return 10;
    case 2:
      return 20;
    case 4:
      return 30;
    case 8:
      return 40;
    case 16:
      return 50;
    default:
      return level;
  }
}

std::uint8_t level_from_wire(std::uint8_t level) {
  switch (level) {
    case 10:
      return 1;
    case 20:
      return 2;
    case 30:
      return 4;
    case 40:
      return 8;
    case 50:
      return 16;
    default:
      return level;
  }
}

// Vectors of numbers are reached through their own type, which is all alike but for the element.
template <class Use>
void with_vector(Kind kind, Use&& use) {
  switch (kind) {
    case Kind::int8:
      return use(static_cast<std::vector<std::int8_t>*>(nullptr));
    case Kind::int16:
      return use(static_cast<std::vector<std::int16_t>*>(nullptr));
    case Kind::uint16:
      return use(static_cast<std::vector<std::uint16_t>*>(nullptr));
    case Kind::int32:
      return use(static_cast<std::vector<std::int32_t>*>(nullptr));
    case Kind::uint32:
      return use(static_cast<std::vector<std::uint32_t>*>(nullptr));
    case Kind::int64:
      return use(static_cast<std::vector<std::int64_t>*>(nullptr));
    case Kind::uint64:
      return use(static_cast<std::vector<std::uint64_t>*>(nullptr));
    case Kind::float32:
      return use(static_cast<std::vector<float>*>(nullptr));
    case Kind::float64:
      return use(static_cast<std::vector<double>*>(nullptr));
    default:
      return use(static_cast<std::vector<std::uint8_t>*>(nullptr));
  }
}

struct TwoWords {
  std::uint32_t seconds;
  std::uint32_t nanoseconds;
};

// Messages whose bytes on the wire are those in memory, so that a vector of them is one piece.
// That is so where all numbers are of one size and nothing lies between them.
struct Plain {
  std::size_t number = 0;  // bytes of each number; 0: not plain
  std::size_t bytes = 0;
};

Plain plain_of(const Layout& layout);

bool add_plain(const Member& member, std::size_t& position, std::size_t& number) {
  if (member.offset != position || member.repeat == Repeat::sequence) {
    return false;
  }
  const std::size_t times = member.repeat == Repeat::fixed ? member.size : 1;
  std::size_t size = 0;
  std::size_t of_number = 0;
  if (member.kind == Kind::message) {
    const Plain inner = plain_of(member.child());
    size = inner.bytes;
    of_number = inner.number;
  } else if (member.kind != Kind::boolean && member.kind != Kind::log_level) {
    of_number = number_size(member.kind);
    size = is_time(member.kind) ? 8 : of_number;
  }
  if (of_number == 0 || (number != 0 && number != of_number)) {
    return false;
  }
  number = of_number;
  position += size * times;
  return true;
}

Plain plain_of(const Layout& layout) {
  std::size_t position = 0;
  std::size_t number = 0;
  for (std::uint32_t i = 0; i < layout.cdr_count; ++i) {
    if (!add_plain(layout.cdr_members[i], position, number)) {
      return {};
    }
  }
  if (position == 0 || position != layout.bytes || layout.cdr_count != layout.count) {
    return {};
  }
  return {number, position};
}

// Worth asking only for many.
constexpr std::size_t many = 8;

struct Counter {
  std::size_t at = 0;
  void skip(std::size_t size) { at += size; }
  void put(const void*, std::size_t size) { at += size; }
};

struct Growing {
  std::vector<std::uint8_t>& bytes;
  std::size_t at = 0;  // counted from the end of the header
  void skip(std::size_t size) {
    bytes.resize(bytes.size() + size);
    at += size;
  }
  void put(const void* data, std::size_t size) {
    const auto* start = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), start, start + size);
    at += size;
  }
};

struct Bounded {
  std::uint8_t* bytes;
  std::size_t size;
  std::size_t at = 0;
  void skip(std::size_t count) {
    std::memset(room(count), 0, count);
    at += count;
  }
  void put(const void* data, std::size_t count) {
    std::memcpy(room(count), data, count);
    at += count;
  }
  std::uint8_t* room(std::size_t count) {
    if (count > size - at) {
      throw Error("the buffer is too small for the message", "InterfaceError");
    }
    return bytes + at;
  }
};

template <class Sink, bool is_cdr>
class Writer {
 public:
  explicit Writer(Sink& sink) : sink_(sink) {}

  void message(const Layout& layout, const void* from) {
    const std::uint32_t count = is_cdr ? layout.cdr_count : layout.count;
    const Member* members = is_cdr ? layout.cdr_members : layout.members;
    if (is_cdr && count == 0) {
      sink_.skip(1);  // rosidl gives empty messages one byte
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      member(layout, members[i], from);
    }
  }

 private:
  void member(const Layout& layout, const Member& member, const void* owner) {
    if (member.offset == absent) {
      missing(member);
      return;
    }
    const auto* from = static_cast<const std::uint8_t*>(owner) + member.offset;
    switch (member.repeat) {
      case Repeat::one:
        single(layout, member, from);
        return;
      case Repeat::fixed:
        repeated(layout, member, from, member.size);
        return;
      case Repeat::sequence:
        sequence(layout, member, from);
        return;
    }
  }

  void single(const Layout& layout, const Member& member, const std::uint8_t* from) {
    switch (member.kind) {
      case Kind::message:
        message(member.child(), from);
        return;
      case Kind::string:
        string(layout, member, *reinterpret_cast<const std::string*>(from));
        return;
      case Kind::wstring:
        wide(layout, member, *reinterpret_cast<const std::u16string*>(from));
        return;
      case Kind::wide_on_wire:
        if (is_cdr) {
          wide(layout, member, widened(*reinterpret_cast<const std::string*>(from)));
        } else {
          string(layout, member, *reinterpret_cast<const std::string*>(from));
        }
        return;
      case Kind::log_level: {
        const std::uint8_t level = is_cdr ? level_to_wire(*from) : *from;
        sink_.put(&level, 1);
        return;
      }
      case Kind::boolean: {
        const std::uint8_t value = is_cdr ? *from != 0 : *from;
        sink_.put(&value, 1);
        return;
      }
      case Kind::time:
      case Kind::duration:
        align(4);
        sink_.put(from, sizeof(TwoWords));
        return;
      default: {
        const std::size_t size = number_size(member.kind);
        align(size);
        sink_.put(from, size);
      }
    }
  }

  // `count` elements that follow each other in memory.
  void repeated(const Layout& layout, const Member& member, const std::uint8_t* from,
                std::size_t count) {
    if (count == 0) {
      return;
    }
    switch (member.kind) {
      case Kind::message: {
        const Layout& child = member.child();
        const std::size_t size = child.bytes;
        if (count >= many) {
          const Plain plain = plain_of(child);
          if (plain.number != 0) {
            align(plain.number);
            sink_.put(from, plain.bytes * count);
            return;
          }
        }
        for (std::size_t i = 0; i < count; ++i) {
          message(child, from + i * size);
        }
        return;
      }
      case Kind::string:
      case Kind::wide_on_wire:
        for (std::size_t i = 0; i < count; ++i) {
          single(layout, member, from + i * sizeof(std::string));
        }
        return;
      case Kind::wstring:
        for (std::size_t i = 0; i < count; ++i) {
          single(layout, member, from + i * sizeof(std::u16string));
        }
        return;
      case Kind::boolean:
      case Kind::log_level:
        for (std::size_t i = 0; i < count; ++i) {
          single(layout, member, from + i);
        }
        return;
      case Kind::time:
      case Kind::duration:
        align(4);
        sink_.put(from, sizeof(TwoWords) * count);
        return;
      default: {
        const std::size_t size = number_size(member.kind);
        align(size);
        sink_.put(from, size * count);
      }
    }
  }

  void sequence(const Layout& layout, const Member& member, const std::uint8_t* from) {
    switch (member.kind) {
      case Kind::message: {
        const Sequence& access = member.sequence();
        const std::size_t count = access.size(from);
        begin_sequence(layout, member, count);
        // Reading a vector's address does not change it.
        repeated(layout, member,
                 static_cast<const std::uint8_t*>(access.data(const_cast<std::uint8_t*>(from))),
                 count);
        return;
      }
      case Kind::string:
      case Kind::wide_on_wire: {
        const auto& values = *reinterpret_cast<const std::vector<std::string>*>(from);
        begin_sequence(layout, member, values.size());
        repeated(layout, member, reinterpret_cast<const std::uint8_t*>(values.data()),
                 values.size());
        return;
      }
      case Kind::wstring: {
        const auto& values = *reinterpret_cast<const std::vector<std::u16string>*>(from);
        begin_sequence(layout, member, values.size());
        repeated(layout, member, reinterpret_cast<const std::uint8_t*>(values.data()),
                 values.size());
        return;
      }
      case Kind::time:
      case Kind::duration: {
        const auto& values = *reinterpret_cast<const std::vector<TwoWords>*>(from);
        begin_sequence(layout, member, values.size());
        repeated(layout, member, reinterpret_cast<const std::uint8_t*>(values.data()),
                 values.size());
        return;
      }
      case Kind::boolean:
        if (!layout.is_ros1) {
          const auto& values = *reinterpret_cast<const std::vector<bool>*>(from);
          begin_sequence(layout, member, values.size());
          for (const bool value : values) {
            const std::uint8_t byte = value;
            sink_.put(&byte, 1);
          }
          return;
        }
        [[fallthrough]];
      default:
        with_vector(member.kind, [&](auto* kind) {
          using Vector = std::remove_pointer_t<decltype(kind)>;
          const auto& values = *reinterpret_cast<const Vector*>(from);
          begin_sequence(layout, member, values.size());
          repeated(layout, member, reinterpret_cast<const std::uint8_t*>(values.data()),
                   values.size());
        });
    }
  }

  void begin_sequence(const Layout& layout, const Member& member, std::size_t count) {
    if (member.size != 0 && count > member.size) {
      fail(layout, member,
           "holds " + std::to_string(count) + " values, at most " + std::to_string(member.size) +
               " are allowed");
    }
    length(layout, member, count);
  }

  void length(const Layout& layout, const Member& member, std::size_t count) {
    if (count > 0xffffffffu) {
      fail(layout, member, "is longer than a message can say");
    }
    const auto value = static_cast<std::uint32_t>(count);
    align(4);
    sink_.put(&value, 4);
  }

  void string(const Layout& layout, const Member& member, const std::string& text) {
    bound(layout, member, text.size());
    if (is_cdr) {
      length(layout, member, text.size() + 1);
      sink_.put(text.c_str(), text.size() + 1);
    } else {
      length(layout, member, text.size());
      sink_.put(text.data(), text.size());
    }
  }

  void wide(const Layout& layout, const Member& member, const std::u16string& text) {
    bound(layout, member, text.size());
    length(layout, member, text.size());
    sink_.put(text.data(), text.size() * sizeof(char16_t));
  }

  void bound(const Layout& layout, const Member& member, std::size_t size) {
    if (member.string_bound != 0 && size > member.string_bound) {
      fail(layout, member,
           "has " + std::to_string(size) + " letters, at most " +
               std::to_string(member.string_bound) + " are allowed");
    }
  }

  // What the class lacks is written as its default.
  void missing(const Member& member) {
    const std::size_t times = member.repeat == Repeat::fixed ? member.size : 1;
    if (member.repeat == Repeat::sequence) {
      align(4);
      sink_.skip(4);
      return;
    }
    for (std::size_t i = 0; i < times; ++i) {
      if (member.kind == Kind::message) {
        message(member.child(), nullptr);
      } else if (member.kind == Kind::string) {
        const std::string text = member.text == nullptr ? "" : member.text;
        align(4);
        const auto size = static_cast<std::uint32_t>(text.size() + 1);
        sink_.put(&size, 4);
        sink_.put(text.c_str(), size);
      } else if (member.kind == Kind::wstring) {
        align(4);
        sink_.skip(4);
      } else {
        const std::size_t size = number_size(member.kind);
        align(size);
        sink_.put(&member.bits, size);
        if (is_time(member.kind)) {
          sink_.skip(4);
        }
      }
    }
  }

  void align(std::size_t size) {
    if (is_cdr) {
      const std::size_t rest = sink_.at & (size - 1);
      if (rest != 0) {
        sink_.skip(size - rest);
      }
    }
  }

  static std::u16string widened(const std::string& text);

  Sink& sink_;
};

void append_utf16(std::u16string& text, std::uint32_t letter) {
  if (letter >= 0x10000u) {
    letter -= 0x10000u;
    text += static_cast<char16_t>(0xd800u + (letter >> 10));
    text += static_cast<char16_t>(0xdc00u + (letter & 0x3ffu));
  } else {
    text += static_cast<char16_t>(letter);
  }
}

constexpr std::size_t no_start = 9;

// How many bytes of UTF-8 follow a first one.
std::size_t letters_after(unsigned char first) {
  if (first < 0x80) {
    return 0;
  }
  if (first < 0xc2 || first > 0xf4) {
    return no_start;
  }
  return first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
}

// Bytes that are no UTF-8 become the replacement letter.
std::u16string utf16_of(const std::string& text) {
  std::u16string made;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t more = letters_after(first);
    std::uint32_t letter = more == 0 ? first : first & (0x3fu >> more);
    bool is_right = more != no_start && i + more < text.size();
    for (std::size_t k = 1; is_right && k <= more; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      is_right = (next & 0xc0) == 0x80;
      letter = (letter << 6) | (next & 0x3fu);
    }
    append_utf16(made, is_right ? letter : 0xfffdu);
    i += is_right ? more + 1 : 1;
  }
  return made;
}

std::string utf8_of(const std::u16string& text) {
  std::string made;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::uint32_t letter = text[i];
    if (letter >= 0xd800u && letter < 0xdc00u && i + 1 < text.size() && text[i + 1] >= 0xdc00u &&
        text[i + 1] < 0xe000u) {
      letter = 0x10000u + ((letter - 0xd800u) << 10) + (text[++i] - 0xdc00u);
    } else if (letter >= 0xd800u && letter < 0xe000u) {
      letter = 0xfffdu;
    }
    if (letter < 0x80u) {
      made += static_cast<char>(letter);
    } else if (letter < 0x800u) {
      made += static_cast<char>(0xc0u | (letter >> 6));
      made += static_cast<char>(0x80u | (letter & 0x3fu));
    } else if (letter < 0x10000u) {
      made += static_cast<char>(0xe0u | (letter >> 12));
      made += static_cast<char>(0x80u | ((letter >> 6) & 0x3fu));
      made += static_cast<char>(0x80u | (letter & 0x3fu));
    } else {
      made += static_cast<char>(0xf0u | (letter >> 18));
      made += static_cast<char>(0x80u | ((letter >> 12) & 0x3fu));
      made += static_cast<char>(0x80u | ((letter >> 6) & 0x3fu));
      made += static_cast<char>(0x80u | (letter & 0x3fu));
    }
  }
  return made;
}

template <class Sink, bool is_cdr>
std::u16string Writer<Sink, is_cdr>::widened(const std::string& text) {
  return utf16_of(text);
}

template <bool is_cdr>
class Reader {
 public:
  Reader(const Layout& whole, const std::uint8_t* bytes, std::size_t size, bool swaps)
      : whole_(whole), bytes_(bytes), size_(size), swaps_(swaps) {}

  std::size_t at() const { return at_; }

  void message(const Layout& layout, void* to) {
    const std::uint32_t count = is_cdr ? layout.cdr_count : layout.count;
    const Member* members = is_cdr ? layout.cdr_members : layout.members;
    if (is_cdr && count == 0) {
      take(1);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      member(layout, members[i], to);
    }
  }

 private:
  void member(const Layout& layout, const Member& member, void* owner) {
    if (member.offset == absent) {
      forget(member);
      return;
    }
    auto* to = static_cast<std::uint8_t*>(owner) + member.offset;
    switch (member.repeat) {
      case Repeat::one:
        repeated(layout, member, to, 1);
        return;
      case Repeat::fixed:
        repeated(layout, member, to, member.size);
        return;
      case Repeat::sequence:
        sequence(layout, member, to);
        return;
    }
  }

  // Into `count` elements that follow each other in memory.
  void repeated(const Layout& layout, const Member& member, std::uint8_t* to, std::size_t count) {
    if (count == 0) {
      return;
    }
    switch (member.kind) {
      case Kind::message: {
        const Layout& child = member.child();
        if (count >= many && !swaps_) {
          const Plain plain = plain_of(child);
          if (plain.number != 0) {
            align(plain.number);
            copy(to, plain.bytes, count);
            return;
          }
        }
        for (std::size_t i = 0; i < count; ++i) {
          message(child, to + i * child.bytes);
        }
        return;
      }
      case Kind::string:
        for (std::size_t i = 0; i < count; ++i) {
          string(*reinterpret_cast<std::string*>(to + i * sizeof(std::string)));
        }
        return;
      case Kind::wide_on_wire:
        for (std::size_t i = 0; i < count; ++i) {
          auto& text = *reinterpret_cast<std::string*>(to + i * sizeof(std::string));
          if (is_cdr) {
            std::u16string wide_text;
            wide(wide_text);
            text = utf8_of(wide_text);
          } else {
            string(text);
          }
        }
        return;
      case Kind::wstring:
        for (std::size_t i = 0; i < count; ++i) {
          wide(*reinterpret_cast<std::u16string*>(to + i * sizeof(std::u16string)));
        }
        return;
      case Kind::boolean: {
        const std::uint8_t* from = take(count);
        for (std::size_t i = 0; i < count; ++i) {
          to[i] = layout.is_ros1 ? from[i] : from[i] != 0;
        }
        return;
      }
      case Kind::log_level: {
        const std::uint8_t* from = take(count);
        for (std::size_t i = 0; i < count; ++i) {
          to[i] = is_cdr ? level_from_wire(from[i]) : from[i];
        }
        return;
      }
      default:
        numbers(member.kind, to, count);
    }
  }

  void numbers(Kind kind, std::uint8_t* to, std::size_t count) {
    const std::size_t size = number_size(kind);
    const std::size_t words = is_time(kind) ? 2 * count : count;
    align(size);
    copy(to, size, words);
    if (swaps_ && size > 1) {
      for (std::size_t i = 0; i < words; ++i) {
        for (std::size_t k = 0; k < size / 2; ++k) {
          std::swap(to[i * size + k], to[i * size + size - 1 - k]);
        }
      }
    }
  }

  void sequence(const Layout& layout, const Member& member, std::uint8_t* to) {
    const std::size_t count = length();
    if (member.size != 0 && count > member.size) {
      fail(layout, member,
           "comes with " + std::to_string(count) + " values, at most " +
               std::to_string(member.size) + " are allowed");
    }
    switch (member.kind) {
      case Kind::message: {
        const Layout& child = member.child();
        const bool is_nothing = !is_cdr && child.count == 0;
        check(count, is_nothing ? 0 : 1);
        const Sequence& access = member.sequence();
        access.resize(to, count);
        repeated(layout, member, static_cast<std::uint8_t*>(access.data(to)), count);
        return;
      }
      case Kind::string:
      case Kind::wide_on_wire: {
        check(count, 4);
        auto& values = *reinterpret_cast<std::vector<std::string>*>(to);
        values.resize(count);
        repeated(layout, member, reinterpret_cast<std::uint8_t*>(values.data()), count);
        return;
      }
      case Kind::wstring: {
        check(count, 4);
        auto& values = *reinterpret_cast<std::vector<std::u16string>*>(to);
        values.resize(count);
        repeated(layout, member, reinterpret_cast<std::uint8_t*>(values.data()), count);
        return;
      }
      case Kind::time:
      case Kind::duration: {
        check(count, 8);
        auto& values = *reinterpret_cast<std::vector<TwoWords>*>(to);
        values.resize(count);
        repeated(layout, member, reinterpret_cast<std::uint8_t*>(values.data()), count);
        return;
      }
      case Kind::boolean:
        if (!layout.is_ros1) {
          const std::uint8_t* from = take(count);
          auto& values = *reinterpret_cast<std::vector<bool>*>(to);
          values.resize(count);
          for (std::size_t i = 0; i < count; ++i) {
            values[i] = from[i] != 0;
          }
          return;
        }
        [[fallthrough]];
      default:
        with_vector(member.kind, [&](auto* kind) {
          using Vector = std::remove_pointer_t<decltype(kind)>;
          constexpr std::size_t size = sizeof(typename Vector::value_type);
          check(count, size);
          auto& values = *reinterpret_cast<Vector*>(to);
          if (swaps_) {
            values.resize(count);
            repeated(layout, member, reinterpret_cast<std::uint8_t*>(values.data()), count);
            return;
          }
          // Built from the bytes, without a first pass of zeros.
          if (count != 0) {
            align(size);
          }
          assign(values, take(count * size), count);
        });
    }
  }

  template <class T>
  static void assign(std::vector<T>& values, const std::uint8_t* from, std::size_t count) {
    if (reinterpret_cast<std::uintptr_t>(from) % alignof(T) == 0) {
      const auto* start = reinterpret_cast<const T*>(from);
      values.assign(start, start + count);
    } else {
      values.resize(count);
      if (count != 0) {
        std::memcpy(values.data(), from, count * sizeof(T));
      }
    }
  }

  void string(std::string& text) {
    const std::size_t count = length();
    const auto* from = reinterpret_cast<const char*>(take(count));
    text.assign(from, is_cdr && count != 0 ? count - 1 : count);
  }

  void wide(std::u16string& text) {
    const std::size_t count = length();
    check(count, sizeof(char16_t));
    text.resize(count);
    copy(reinterpret_cast<std::uint8_t*>(text.data()), sizeof(char16_t), count);
    if (swaps_) {
      for (char16_t& letter : text) {
        letter = static_cast<char16_t>((letter >> 8) | (letter << 8));
      }
    }
  }

  // What the class has no place for.
  void forget(const Member& member) {
    std::size_t count = member.repeat == Repeat::fixed ? member.size : 1;
    if (member.repeat == Repeat::sequence) {
      count = length();
      check(count, 1);
    }
    if (count == 0) {
      return;
    }
    std::string text;
    std::u16string wide_text;
    switch (member.kind) {
      case Kind::message:
        for (std::size_t i = 0; i < count; ++i) {
          message(member.child(), nullptr);
        }
        return;
      case Kind::string:
        for (std::size_t i = 0; i < count; ++i) {
          string(text);
        }
        return;
      case Kind::wstring:
      case Kind::wide_on_wire:
        for (std::size_t i = 0; i < count; ++i) {
          wide(wide_text);
        }
        return;
      default: {
        const std::size_t size = number_size(member.kind);
        align(size);
        check(count, size);
        take((is_time(member.kind) ? 2 : 1) * size * count);
      }
    }
  }

  std::size_t length() {
    std::uint32_t count = 0;
    align(4);
    copy(reinterpret_cast<std::uint8_t*>(&count), 4, 1);
    if (swaps_) {
      count = (count >> 24) | ((count >> 8) & 0xff00u) | ((count << 8) & 0xff0000u) | (count << 24);
    }
    return count;
  }

  // Before memory is asked for: so many of at least that size must be there.
  void check(std::size_t count, std::size_t size) const {
    if (size != 0 && count > (size_ - at_) / size) {
      cut_short(whole_, size_);
    }
  }

  void copy(std::uint8_t* to, std::size_t size, std::size_t count) {
    check(count, size);
    const std::uint8_t* from = take(size * count);
    if (size * count != 0) {
      std::memcpy(to, from, size * count);
    }
  }

  const std::uint8_t* take(std::size_t size) {
    if (size > size_ - at_) {
      cut_short(whole_, size_);
    }
    const std::uint8_t* from = bytes_ + at_;
    at_ += size;
    return from;
  }

  void align(std::size_t size) {
    if (is_cdr) {
      const std::size_t rest = at_ & (size - 1);
      if (rest != 0) {
        take(size - rest);
      }
    }
  }

  const Layout& whole_;
  const std::uint8_t* bytes_;
  std::size_t size_;
  std::size_t at_ = 0;
  bool swaps_;
};

}  // namespace

void encode_cdr(const Layout& layout, const void* message, std::vector<std::uint8_t>& cdr) {
  cdr.assign({0, 1, 0, 0});
  Growing sink{cdr};
  Writer<Growing, true>(sink).message(layout, message);
}

void decode_cdr(const Layout& layout, void* message, const std::uint8_t* cdr, std::size_t size) {
  if (size < header_size) {
    cut_short(layout, size);
  }
  if (cdr[0] != 0 || cdr[1] > 1) {
    throw Error(std::to_string(size) + " bytes are not a " + layout.type +
                    ": their header is not that of plain CDR (00 00 or 00 01)",
                "InterfaceError");
  }
  Reader<true>(layout, cdr + header_size, size - header_size, cdr[1] == 0).message(layout, message);
}

void encode_ros1(const Layout& layout, const void* message, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  Growing sink{bytes};
  Writer<Growing, false>(sink).message(layout, message);
}

std::size_t ros1_size(const Layout& layout, const void* message) {
  Counter sink;
  Writer<Counter, false>(sink).message(layout, message);
  return sink.at;
}

std::size_t encode_ros1(const Layout& layout, const void* message, std::uint8_t* bytes,
                        std::size_t size) {
  Bounded sink{bytes, size};
  Writer<Bounded, false>(sink).message(layout, message);
  return sink.at;
}

std::size_t decode_ros1(const Layout& layout, void* message, const std::uint8_t* bytes,
                        std::size_t size) {
  Reader<false> reader(layout, bytes, size, false);
  reader.message(layout, message);
  return reader.at();
}

}  // namespace gazelle
