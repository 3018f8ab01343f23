// The source of tests' library of codecs; `message_probe.py` writes includes and rows.
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include <gazelle/message.hpp>

// INCLUDES

namespace {

struct Row {
  const char* name;
  const gazelle::MessageType& (*type)();
};

const Row rows[] = {
    // ROWS
};

std::vector<std::uint8_t> bytes(const std::string& text) { return {text.begin(), text.end()}; }

std::vector<std::uint8_t> answer(const gazelle::MessageType& type, int what,
                                 const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> out;
  std::ostringstream text;
  switch (what) {
    case 0:
      type.encode(type.decode(data, size).get(), out);
      return out;
    case 1:
      gazelle::encode_ros1(*type.layout, type.decode(data, size).get(), out);
      return out;
    case 2: {
      const auto message = type.create();
      if (gazelle::decode_ros1(*type.layout, message.get(), data, size) != size ||
          gazelle::ros1_size(*type.layout, message.get()) != size) {
        throw gazelle::Error("the size is another one");
      }
      type.encode(message.get(), out);
      return out;
    }
    case 3:
      return bytes(type.definition());
    case 4:
    case 5:
      gazelle::print_yaml(text, *type.layout, type.decode(data, size).get(), 0, what == 5);
      return bytes(text.str());
    case 6:
      gazelle::print_ros1(text, *type.layout, type.decode(data, size).get());
      return bytes(text.str());
    case 7:
      type.encode(type.create().get(), out);
      return out;
    default:
      return bytes(std::string(type.name) + "\n" + type.ros1_name + "\n" + type.md5 + "\n" +
                   type.hash);
  }
}

}  // namespace

// 0: the sink has the answer; 1: nobody knows the type; 2: the sink has what went wrong.
extern "C" int probe(const char* name, int what, const std::uint8_t* data, std::size_t size,
                     void (*sink)(const std::uint8_t*, std::size_t)) {
  for (const Row& row : rows) {
    if (std::strcmp(row.name, name) == 0) {
      try {
        const std::vector<std::uint8_t> found = answer(row.type(), what, data, size);
        sink(found.data(), found.size());
        return 0;
      } catch (const gazelle::Error& error) {
        sink(reinterpret_cast<const std::uint8_t*>(error.what()), std::strlen(error.what()));
        return 2;
      }
    }
  }
  return 1;
}
