// Texts of messages by their tables: whole definitions, and values as ROS prints them.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <iomanip>
#include <map>
#include <mutex>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include <gazelle/message.hpp>

namespace gazelle {
namespace {

const std::string rule = std::string(80, '=') + "\n";

// The messages inside one, in the order in which its text tells of them: fields of ROS 1 as they
// come, those of ROS 2 by name.
std::vector<const Layout*> children(const Layout& layout) {
  std::vector<const Layout*> found;
  for (std::uint32_t i = 0; i < layout.count; ++i) {
    if (layout.members[i].kind == Kind::message) {
      found.push_back(&layout.members[i].child());
    }
  }
  if (!layout.is_ros1) {
    std::stable_sort(found.begin(), found.end(), [](const Layout* l, const Layout* r) {
      return std::strcmp(l->type, r->type) < 0;
    });
  }
  return found;
}

void add_inner(const Layout& layout, std::set<std::string>& seen, std::string& text) {
  for (const Layout* child : children(layout)) {
    if (!seen.insert(child->type).second) {
      continue;
    }
    text += "\n" + rule + "MSG: " + child->ros1_type + "\n" + child->text;
    add_inner(*child, seen, text);
  }
}

// A member's elements, wherever they lie.
class Elements {
 public:
  Elements(const Layout& layout, const Member& member, const void* owner)
      : member_(member), from_(static_cast<const std::uint8_t*>(owner) + member.offset) {
    switch (member.repeat) {
      case Repeat::one:
        count_ = 1;
        return;
      case Repeat::fixed:
        count_ = member.size;
        return;
      case Repeat::sequence:
        sequence(layout);
        return;
    }
  }

  std::size_t count() const { return count_; }

  // Of flags in a std::vector<bool>, a byte of ours.
  const std::uint8_t* at(std::size_t i) const {
    if (flags_ != nullptr) {
      static const std::uint8_t values[] = {0, 1};
      return &values[(*flags_)[i] ? 1 : 0];
    }
    return from_ + i * size();
  }

 private:
  std::size_t size() const {
    switch (member_.kind) {
      case Kind::message:
        return member_.child().bytes;
      case Kind::string:
      case Kind::wide_on_wire:
        return sizeof(std::string);
      case Kind::wstring:
        return sizeof(std::u16string);
      case Kind::int16:
      case Kind::uint16:
        return 2;
      case Kind::int32:
      case Kind::uint32:
      case Kind::float32:
        return 4;
      case Kind::int64:
      case Kind::uint64:
      case Kind::float64:
      case Kind::time:
      case Kind::duration:
        return 8;
      default:
        return 1;
    }
  }

  void sequence(const Layout& layout) {
    if (member_.kind == Kind::message) {
      const Sequence& access = member_.sequence();
      count_ = access.size(from_);
      from_ = static_cast<const std::uint8_t*>(access.data(const_cast<std::uint8_t*>(from_)));
    } else if (member_.kind == Kind::boolean && !layout.is_ros1) {
      flags_ = reinterpret_cast<const std::vector<bool>*>(from_);
      count_ = flags_->size();
    } else {
      // All vectors of the standard library begin and end by two pointers.
      const auto& bytes = *reinterpret_cast<const std::vector<std::uint8_t>*>(from_);
      count_ = bytes.size() / size();
      from_ = bytes.data();
    }
  }

  const Member& member_;
  const std::uint8_t* from_;
  const std::vector<bool>* flags_ = nullptr;
  std::size_t count_ = 0;
};

template <class T>
T as(const std::uint8_t* from) {
  T value;
  std::memcpy(&value, from, sizeof(value));
  return value;
}

// Seconds and nanoseconds as ros::Time and ros::Duration print them.
void print_time(std::ostream& stream, Kind kind, const std::uint8_t* from) {
  char text[32];
  if (kind == Kind::time) {
    std::snprintf(text, sizeof(text), "%u.%09u", as<std::uint32_t>(from),
                  as<std::uint32_t>(from + 4));
  } else {
    const auto seconds = as<std::int32_t>(from);
    const auto nanoseconds = as<std::int32_t>(from + 4);
    const bool is_negative = seconds < 0 && nanoseconds > 0;
    std::snprintf(text, sizeof(text), "%s%d.%09d", is_negative && seconds == -1 ? "-" : "",
                  is_negative ? seconds + 1 : seconds,
                  is_negative ? 1000000000 - nanoseconds : nanoseconds);
  }
  stream << text;
}

void print_number(std::ostream& stream, Kind kind, const std::uint8_t* from) {
  switch (kind) {
    case Kind::int8:
    case Kind::log_level:
      stream << static_cast<int>(as<std::int8_t>(from));
      return;
    case Kind::int16:
      stream << as<std::int16_t>(from);
      return;
    case Kind::uint16:
      stream << as<std::uint16_t>(from);
      return;
    case Kind::int32:
      stream << as<std::int32_t>(from);
      return;
    case Kind::uint32:
      stream << as<std::uint32_t>(from);
      return;
    case Kind::int64:
      stream << as<std::int64_t>(from);
      return;
    case Kind::uint64:
      stream << as<std::uint64_t>(from);
      return;
    case Kind::float32:
      stream << as<float>(from);
      return;
    case Kind::float64:
      stream << as<double>(from);
      return;
    default:
      stream << static_cast<unsigned>(*from);
  }
}

void print_plain(std::ostream& stream, Kind kind, const std::uint8_t* from) {
  switch (kind) {
    case Kind::string:
    case Kind::wide_on_wire:
      stream << *reinterpret_cast<const std::string*>(from);
      return;
    case Kind::time:
    case Kind::duration:
      print_time(stream, kind, from);
      return;
    default:
      print_number(stream, kind, from);
  }
}

void print_quoted(std::ostream& stream, const std::string& text) {
  stream << '"';
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') {
      stream << '\\';
    }
    stream << letter;
  }
  stream << '"';
}

void print_quoted(std::ostream& stream, const std::u16string& text) {
  stream << '"';
  for (const char16_t letter : text) {
    char written[8];
    if (letter < 0x80) {
      stream << static_cast<char>(letter);
      continue;
    }
    std::snprintf(written, sizeof(written), letter < 0x100 ? "\\x%02x" : "\\u%04x",
                  static_cast<unsigned>(letter));
    stream << written;
  }
  stream << '"';
}

void print_value(std::ostream& stream, Kind kind, const std::uint8_t* from) {
  switch (kind) {
    case Kind::string:
    case Kind::wide_on_wire:
      print_quoted(stream, *reinterpret_cast<const std::string*>(from));
      return;
    case Kind::wstring:
      print_quoted(stream, *reinterpret_cast<const std::u16string*>(from));
      return;
    case Kind::boolean:
      stream << (*from != 0 ? "true" : "false");
      return;
    case Kind::byte: {
      char written[8];
      std::snprintf(written, sizeof(written), "0x%02x", static_cast<unsigned>(*from));
      stream << written;
      return;
    }
    case Kind::float32:
    case Kind::float64: {
      const auto flags = stream.flags();
      stream << std::showpoint;
      print_number(stream, kind, from);
      stream.flags(flags);
      return;
    }
    default:
      print_plain(stream, kind, from);
  }
}

void print_flow(std::ostream& stream, const Layout& layout, const void* message);

void print_flow_value(std::ostream& stream, const Member& member, const std::uint8_t* from) {
  if (member.kind == Kind::message) {
    print_flow(stream, member.child(), from);
  } else {
    print_value(stream, member.kind, from);
  }
}

void print_flow(std::ostream& stream, const Layout& layout, const void* message) {
  if (layout.count == 0) {
    stream << "null";
    return;
  }
  stream << '{';
  for (std::uint32_t i = 0; i < layout.count; ++i) {
    const Member& member = layout.members[i];
    const Elements elements(layout, member, message);
    stream << (i == 0 ? "" : ", ") << member.name << ": ";
    if (member.repeat == Repeat::one) {
      print_flow_value(stream, member, elements.at(0));
      continue;
    }
    stream << '[';
    for (std::size_t k = 0; k < elements.count(); ++k) {
      stream << (k == 0 ? "" : ", ");
      print_flow_value(stream, member, elements.at(k));
    }
    stream << ']';
  }
  stream << '}';
}

void print_block(std::ostream& stream, const Layout& layout, const void* message,
                 std::size_t indentation) {
  const std::string indent(indentation, ' ');
  if (layout.count == 0) {
    stream << "null\n";
    return;
  }
  for (std::uint32_t i = 0; i < layout.count; ++i) {
    const Member& member = layout.members[i];
    const Elements elements(layout, member, message);
    stream << indent << member.name << ":";
    if (member.repeat == Repeat::one && member.kind != Kind::message) {
      stream << ' ';
      print_value(stream, member.kind, elements.at(0));
      stream << '\n';
    } else if (member.repeat == Repeat::one) {
      stream << '\n';
      print_block(stream, member.child(), elements.at(0), indentation + 2);
    } else if (elements.count() == 0) {
      stream << " []\n";
    } else {
      stream << '\n';
      for (std::size_t k = 0; k < elements.count(); ++k) {
        stream << indent << '-';
        if (member.kind == Kind::message) {
          stream << '\n';
          print_block(stream, member.child(), elements.at(k), indentation + 2);
        } else {
          stream << ' ';
          print_value(stream, member.kind, elements.at(k));
          stream << '\n';
        }
      }
    }
  }
}

}  // namespace

const char* full_definition(const Layout& layout) {
  static std::mutex lock;
  static auto& texts = *new std::map<const Layout*, std::string>;  // kept to the process's end
  const std::lock_guard<std::mutex> guard(lock);
  std::string& text = texts[&layout];
  if (text.empty()) {
    text = layout.text;
    std::set<std::string> seen;
    add_inner(layout, seen, text);
  }
  return text.c_str();
}

void print_ros1(std::ostream& stream, const Layout& layout, const void* message,
                const std::string& indent) {
  for (std::uint32_t i = 0; i < layout.count; ++i) {
    const Member& member = layout.members[i];
    const Elements elements(layout, member, message);
    if (member.repeat == Repeat::one) {
      stream << indent << member.name << ": ";
      if (member.kind == Kind::message) {
        stream << '\n';
        print_ros1(stream, member.child(), elements.at(0), indent + "  ");
      } else {
        print_plain(stream, member.kind, elements.at(0));
        stream << '\n';
      }
      continue;
    }
    stream << indent << member.name << "[]\n";
    for (std::size_t k = 0; k < elements.count(); ++k) {
      stream << indent << "  " << member.name << '[' << k << "]: ";
      if (member.kind == Kind::message) {
        stream << '\n' << indent;
        print_ros1(stream, member.child(), elements.at(k), indent + "    ");
      } else {
        print_plain(stream, member.kind, elements.at(k));
        stream << '\n';
      }
    }
  }
}

void print_yaml(std::ostream& stream, const Layout& layout, const void* message,
                std::size_t indentation, bool flow_style) {
  if (flow_style) {
    print_flow(stream, layout, message);
  } else {
    print_block(stream, layout, message, indentation);
  }
}

}  // namespace gazelle
