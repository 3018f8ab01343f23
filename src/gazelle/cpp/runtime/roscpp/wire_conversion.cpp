// A message from CDR to ROS 1's bytes and back, without a class of it: the host says in which order
// a type's fields lie in either, and whole arrays of numbers are copied.

#include <ros/foreign_message.h>
#include <rosgraph_msgs/Log.h>
#include <gazelle/cdr.hpp>
#include <gazelle/core.hpp>
#include <gazelle/message.hpp>

#include <cstring>
#include <map>
#include <memory>
#include <mutex>

namespace ros {
namespace detail {

namespace {

using gazelle::Error;
using gazelle::Json;

enum class Repeat { kOne, kFixed, kSequence };

struct Type;

// A field in the bytes of one kind.
struct Slot {
  std::string name;
  std::size_t size = 0;         // of a number; 0: text or message
  const Type* child = nullptr;  // of a message
  Repeat repeat = Repeat::kOne;
  uint32_t count = 0;  // of a fixed array
  int other = -1;      // its place in the other kind of bytes; -1: it is not there
};

struct Type {
  std::vector<Slot> cdr, ros1;
  std::string definition, md5;
};

// Reads or writes with the alignment of the bytes' kind.
struct Reader {
  const uint8_t* data;
  std::size_t size;
  std::size_t at = 0;
  bool is_cdr;

  void align(std::size_t width) {
    if (is_cdr && width > 1) at = (at + width - 1) / width * width;
  }
  const uint8_t* take(std::size_t wanted) {
    if (wanted > size || at > size - wanted) throw Error("the message is shorter than its type");
    const uint8_t* const found = data + at;
    at += wanted;
    return found;
  }
  uint32_t length() {
    align(4);
    uint32_t value;
    std::memcpy(&value, take(4), 4);
    return value;
  }
};

struct Writer {
  std::vector<uint8_t>& bytes;
  std::size_t begin;  // alignment counts from here
  bool is_cdr;

  void align(std::size_t width) {
    if (is_cdr && width > 1)
      bytes.resize(begin + (bytes.size() - begin + width - 1) / width * width);
  }
  void put(const void* data, std::size_t size) {
    const auto* const from = static_cast<const uint8_t*>(data);
    bytes.insert(bytes.end(), from, from + size);
  }
  void length(uint32_t value) {
    align(4);
    put(&value, 4);
  }
};

const std::vector<Slot>& slotsOf(const Type& type, bool is_cdr) {
  return is_cdr ? type.cdr : type.ros1;
}

void skip(const Slot& slot, Reader& from);

void skipMessage(const Type& type, Reader& from) {
  for (const Slot& slot : slotsOf(type, from.is_cdr)) skip(slot, from);
}

void skip(const Slot& slot, Reader& from) {
  const uint32_t count = slot.repeat == Repeat::kOne     ? 1
                         : slot.repeat == Repeat::kFixed ? slot.count
                                                         : from.length();
  if (slot.size) {
    if (count) from.align(slot.size);
    from.take(slot.size * count);
    return;
  }
  for (uint32_t i = 0; i < count; ++i) {
    if (slot.child)
      skipMessage(*slot.child, from);
    else
      from.take(from.length());
  }
}

void putDefault(const Slot& slot, Writer& to) {
  const uint32_t count = slot.repeat == Repeat::kOne ? 1 : slot.count;
  if (slot.repeat == Repeat::kSequence) {
    to.length(0);
    return;
  }
  if (slot.size && count) to.align(slot.size);
  for (uint32_t i = 0; i < count; ++i) {
    if (slot.size) {
      to.bytes.resize(to.bytes.size() + slot.size);
    } else if (slot.child) {
      for (const Slot& inner : slotsOf(*slot.child, to.is_cdr)) putDefault(inner, to);
    } else {
      to.length(to.is_cdr ? 1 : 0);
      if (to.is_cdr) to.bytes.push_back(0);
    }
  }
}

void convertMessage(const Type& type, Reader& from, Writer& to);

void convert(const Slot& slot, Reader& from, Writer& to) {
  uint32_t count = 1;
  if (slot.repeat == Repeat::kFixed) {
    count = slot.count;
  } else if (slot.repeat == Repeat::kSequence) {
    count = from.length();
    to.length(count);
  }
  if (slot.size) {
    if (count == 0) return;
    from.align(slot.size);
    to.align(slot.size);
    to.put(from.take(slot.size * count), slot.size * count);
    return;
  }
  for (uint32_t i = 0; i < count; ++i) {
    if (slot.child) {
      convertMessage(*slot.child, from, to);
      continue;
    }
    uint32_t length = from.length();
    const uint8_t* const text = from.take(length);
    // CDR counts the zero behind the text.
    if (from.is_cdr && length) --length;
    to.length(length + (to.is_cdr ? 1 : 0));
    to.put(text, length);
    if (to.is_cdr) to.bytes.push_back(0);
  }
}

void convertMessage(const Type& type, Reader& from, Writer& to) {
  const std::vector<Slot>& source = slotsOf(type, from.is_cdr);
  const std::vector<Slot>& target = slotsOf(type, to.is_cdr);
  std::vector<std::size_t> places(source.size());
  Reader ahead = from;
  // In the same order, as nearly all are, one pass does.
  std::size_t next = 0;
  bool is_ordered = true;
  for (const Slot& slot : target) {
    if (slot.other < 0) continue;
    is_ordered = is_ordered && static_cast<std::size_t>(slot.other) >= next;
    next = static_cast<std::size_t>(slot.other) + 1;
  }
  if (is_ordered) {
    next = 0;
    for (const Slot& slot : target) {
      if (slot.other < 0) {
        putDefault(slot, to);
        continue;
      }
      while (next < static_cast<std::size_t>(slot.other)) skip(source[next++], from);
      convert(slot, from, to);
      ++next;
    }
    while (next < source.size()) skip(source[next++], from);
    return;
  }
  for (std::size_t i = 0; i < source.size(); ++i) {
    places[i] = ahead.at;
    skip(source[i], ahead);
  }
  for (const Slot& slot : target) {
    if (slot.other < 0) {
      putDefault(slot, to);
      continue;
    }
    Reader there = from;
    there.at = places[static_cast<std::size_t>(slot.other)];
    convert(slot, there, to);
  }
  from.at = ahead.at;
}

// Types by name, as the host describes them.
struct Types {
  std::mutex mutex;
  std::map<std::string, std::unique_ptr<Type> > known;
};

Types& types() {
  static Types* const state = new Types;
  return *state;
}

const Type& typeLocked(const std::string& name, const Json& described);

std::vector<Slot> slotsFrom(const Json& rows, const Json& described) {
  std::vector<Slot> slots;
  for (const Json& row : rows.items()) {
    Slot slot;
    slot.name = row["name"].as_string();
    slot.size = static_cast<std::size_t>(row["size"].as_int());
    const std::string repeat = row["repeat"].as_string();
    slot.repeat = repeat == "one"     ? Repeat::kOne
                  : repeat == "fixed" ? Repeat::kFixed
                                      : Repeat::kSequence;
    slot.count = static_cast<uint32_t>(row["count"].as_int());
    if (row["type"].is_string()) slot.child = &typeLocked(row["type"].as_string(), described);
    slots.push_back(slot);
  }
  return slots;
}

void match(std::vector<Slot>& slots, const std::vector<Slot>& others) {
  for (Slot& slot : slots)
    for (std::size_t i = 0; i < others.size(); ++i)
      if (!slot.name.empty() && others[i].name == slot.name) slot.other = static_cast<int>(i);
}

const Type& typeLocked(const std::string& name, const Json& described) {
  const Json& own = described[name];
  std::unique_ptr<Type>& kept = types().known[name];
  if (kept) {  // others hold pointers to it
    if (kept->md5.empty()) {
      kept->definition = own["definition"].as_string();
      kept->md5 = own["md5"].as_string();
    }
    return *kept;
  }
  auto made = std::make_unique<Type>();
  made->cdr = slotsFrom(own["cdr"], described);
  made->ros1 = slotsFrom(own["ros1"], described);
  match(made->cdr, made->ros1);
  match(made->ros1, made->cdr);
  made->definition = own["definition"].as_string();
  made->md5 = own["md5"].as_string();
  std::unique_ptr<Type>& place = types().known[name];
  place = std::move(made);
  return *place;
}

const Type& typeOf(const std::string& given, const std::string& definition) {
  const std::string name = ros2TypeName(given);
  const std::lock_guard<std::mutex> lock(types().mutex);
  const auto found = types().known.find(name);
  if (found != types().known.end() && found->second && !found->second->md5.empty())
    return *found->second;
  const Json described =
      gazelle::call("wire/type", Json::object({{"type", name}, {"definition", definition}}));
  return typeLocked(name, described);
}

// The one type that is another one on the graph; its class knows both.
bool isLog(const std::string& type) {
  return type == "rosgraph_msgs/msg/Log" || type == "rosgraph_msgs/Log" ||
         type == "rcl_interfaces/msg/Log";
}

}  // namespace

std::vector<uint8_t> ros1FromCdr(const std::string& type, const std::string& definition,
                                 const uint8_t* cdr, std::size_t size) {
  std::vector<uint8_t> bytes;
  if (isLog(type)) {
    rosgraph_msgs::Log log;
    gazelle::from_cdr(log, cdr, size);
    gazelle::encode_ros1(gazelle::Description<rosgraph_msgs::Log>::layout(), &log, bytes);
    return bytes;
  }
  if (size < 4) throw Error("the message is shorter than the header of CDR");
  bytes.reserve(size);
  Reader from{cdr + 4, size - 4, 0, true};
  Writer to{bytes, 0, false};
  convertMessage(typeOf(type, definition), from, to);
  return bytes;
}

std::vector<uint8_t> cdrFromRos1(const std::string& type, const std::string& definition,
                                 const uint8_t* bytes, std::size_t size) {
  std::vector<uint8_t> cdr;
  if (isLog(type)) {
    rosgraph_msgs::Log log;
    gazelle::decode_ros1(gazelle::Description<rosgraph_msgs::Log>::layout(), &log, bytes, size);
    gazelle::to_cdr(log, cdr);
    return cdr;
  }
  cdr.reserve(size + size / 8 + 16);
  cdr.assign({0, 1, 0, 0});
  Reader from{bytes, size, 0, false};
  Writer to{cdr, 4, true};
  convertMessage(typeOf(type, definition), from, to);
  if (cdr.size() == 4) cdr.push_back(0);  // a message without fields is one byte
  return cdr;
}

std::string ros2TypeName(const std::string& type, const char* folder) {
  const std::size_t slash = type.find('/');
  if (slash == std::string::npos || type.find('/', slash + 1) != std::string::npos) return type;
  return type.substr(0, slash) + "/" + folder + type.substr(slash);
}

std::string ros1TypeName(const std::string& type) {
  const std::size_t first = type.find('/');
  const std::size_t last = type.rfind('/');
  return first == last ? type : type.substr(0, first) + type.substr(last);
}

const std::string& definitionOf(const std::string& type) { return typeOf(type, "").definition; }
const std::string& md5Of(const std::string& type) { return typeOf(type, "").md5; }

}  // namespace detail
}  // namespace ros
