#include "gazelle/json.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "gazelle/error.hpp"

namespace gazelle {

namespace {

const Json& nothing() {
  static const auto* one = new Json;
  return *one;
}

constexpr int kMaxDepth = 500;

class Reader {
 public:
  Reader(const char* text, std::size_t size) : at_(text), begin_(text), end_(text + size) {}

  Json whole() {
    Json value = read(0);
    skip();
    if (at_ != end_) fail("something stands behind the value");
    return value;
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw Error("JSON: " + std::string(what) + " at byte " + std::to_string(at_ - begin_));
  }

  void skip() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\t' || *at_ == '\r')) ++at_;
  }

  bool takes(const char* word) {
    const std::size_t size = std::strlen(word);
    if (static_cast<std::size_t>(end_ - at_) < size || std::memcmp(at_, word, size) != 0) {
      return false;
    }
    at_ += size;
    return true;
  }

  Json read(int depth) {
    if (depth > kMaxDepth) fail("values lie too deep in one another");
    skip();
    if (at_ == end_) fail("a value is missing");
    switch (*at_) {
      case '{':
        return object(depth);
      case '[':
        return array(depth);
      case '"':
        return text();
      case 't':
        if (takes("true")) return true;
        break;
      case 'f':
        if (takes("false")) return false;
        break;
      case 'n':
        if (takes("null")) return nullptr;
        break;
      case 'N':
        if (takes("NaN")) return std::numeric_limits<double>::quiet_NaN();
        break;
      case 'I':
        if (takes("Infinity")) return std::numeric_limits<double>::infinity();
        break;
      case '-':
        if (takes("-Infinity")) return -std::numeric_limits<double>::infinity();
        return number();
      default:
        return number();
    }
    fail("this is no value");
  }

  Json object(int depth) {
    ++at_;
    Json::Object members;
    skip();
    if (at_ != end_ && *at_ == '}') {
      ++at_;
      return members;
    }
    while (true) {
      skip();
      if (at_ == end_ || *at_ != '"') fail("a name is missing");
      std::string name = text();
      skip();
      if (at_ == end_ || *at_++ != ':') fail("a colon is missing");
      Json value = read(depth + 1);
      members.emplace_back(std::move(name), std::move(value));
      skip();
      if (at_ == end_) fail("an object has no end");
      const char next = *at_++;
      if (next == '}') return members;
      if (next != ',') fail("a comma is missing");
    }
  }

  Json array(int depth) {
    ++at_;
    Json::Array items;
    skip();
    if (at_ != end_ && *at_ == ']') {
      ++at_;
      return items;
    }
    while (true) {
      items.push_back(read(depth + 1));
      skip();
      if (at_ == end_) fail("an array has no end");
      const char next = *at_++;
      if (next == ']') return items;
      if (next != ',') fail("a comma is missing");
    }
  }

  unsigned code_unit() {
    unsigned value = 0;
    if (end_ - at_ < 4) fail("an escape is cut off");
    const auto found = std::from_chars(at_, at_ + 4, value, 16);
    if (found.ptr != at_ + 4) fail("an escape has no four digits");
    at_ += 4;
    return value;
  }

  static void put_utf8(std::string& out, unsigned code) {
    if (code < 0x80) {
      out += static_cast<char>(code);
    } else if (code < 0x800) {
      out += static_cast<char>(0xC0 | code >> 6);
      out += static_cast<char>(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
      out += static_cast<char>(0xE0 | code >> 12);
      out += static_cast<char>(0x80 | (code >> 6 & 0x3F));
      out += static_cast<char>(0x80 | (code & 0x3F));
    } else {
      out += static_cast<char>(0xF0 | code >> 18);
      out += static_cast<char>(0x80 | (code >> 12 & 0x3F));
      out += static_cast<char>(0x80 | (code >> 6 & 0x3F));
      out += static_cast<char>(0x80 | (code & 0x3F));
    }
  }

  void escape(std::string& out) {
    if (at_ == end_) fail("an escape is cut off");
    switch (const char what = *at_++; what) {
      case 'n':
        out += '\n';
        break;
      case 't':
        out += '\t';
        break;
      case 'r':
        out += '\r';
        break;
      case 'b':
        out += '\b';
        break;
      case 'f':
        out += '\f';
        break;
      case 'u': {
        unsigned code = code_unit();
        if (code >= 0xDC80 && code <= 0xDCFF) {
          // A byte that is no UTF-8, as Python's surrogateescape writes it.
          out += static_cast<char>(code - 0xDC00);
          break;
        }
        if (code >= 0xD800 && code < 0xDC00 && end_ - at_ >= 6 && at_[0] == '\\' && at_[1] == 'u') {
          at_ += 2;
          code = 0x10000 + ((code - 0xD800) << 10) + (code_unit() - 0xDC00);
        }
        put_utf8(out, code);
        break;
      }
      default:
        out += what;
    }
  }

  std::string text() {
    ++at_;
    std::string out;
    while (true) {
      const char* start = at_;
      while (at_ != end_ && *at_ != '"' && *at_ != '\\') ++at_;
      out.append(start, at_);
      if (at_ == end_) fail("a text has no end");
      if (*at_++ == '"') return out;
      escape(out);
    }
  }

  Json number() {
    const char* start = at_;
    bool is_whole = true;
    while (at_ != end_ && std::strchr("+-0123456789.eE", *at_) != nullptr && *at_ != '\0') {
      is_whole = is_whole && (*at_ == '-' || (*at_ >= '0' && *at_ <= '9'));
      ++at_;
    }
    if (is_whole) {
      std::int64_t value = 0;
      const auto found = std::from_chars(start, at_, value);
      if (found.ptr == at_ && found.ec == std::errc() && start != at_) return Json(value);
    }
    double value = 0.0;
    const auto found = std::from_chars(start, at_, value);
    if (start == at_ || found.ptr != at_) fail("this is no value");
    if (found.ec == std::errc::result_out_of_range) value = std::strtod(start, nullptr);
    return value;
  }

  const char* at_;
  const char* begin_;
  const char* end_;
};

// The length of a UTF-8 sequence that begins here, 0 where there is none.
std::size_t sequence_at(const unsigned char* at, const unsigned char* end) {
  std::size_t size = 0;
  unsigned code = 0;
  if (*at < 0x80) return 1;
  if (*at >= 0xC2 && *at < 0xE0) {
    size = 2;
    code = *at & 0x1F;
  } else if (*at >= 0xE0 && *at < 0xF0) {
    size = 3;
    code = *at & 0x0F;
  } else if (*at >= 0xF0 && *at < 0xF5) {
    size = 4;
    code = *at & 0x07;
  } else {
    return 0;
  }
  if (static_cast<std::size_t>(end - at) < size) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((at[i] & 0xC0) != 0x80) return 0;
    code = code << 6 | (at[i] & 0x3F);
  }
  static constexpr unsigned kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < kLeast[size] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return 0;
  return size;
}

void write_text(std::string& out, const std::string& text) {
  out += '"';
  const auto* at = reinterpret_cast<const unsigned char*>(text.data());
  const auto* end = at + text.size();
  char code[8];
  while (at != end) {
    if (*at == '"' || *at == '\\') {
      out += '\\';
      out += static_cast<char>(*at++);
    } else if (*at < 0x20) {
      std::snprintf(code, sizeof code, "\\u%04x", *at++);
      out += code;
    } else if (const std::size_t size = sequence_at(at, end)) {
      out.append(reinterpret_cast<const char*>(at), size);
      at += size;
    } else {
      std::snprintf(code, sizeof code, "\\udc%02x", *at++);
      out += code;
    }
  }
  out += '"';
}

void write_number(std::string& out, double value) {
  if (std::isnan(value)) {
    out += "NaN";
  } else if (std::isinf(value)) {
    out += value > 0 ? "Infinity" : "-Infinity";
  } else {
    char text[40];
    const auto found = std::to_chars(text, text + sizeof text, value);
    const std::string written(text, found.ptr);
    out += written;
    // It must come back as a number with a fraction, not as a whole one.
    if (written.find_first_of(".eEn") == std::string::npos) out += ".0";
  }
}

}  // namespace

Json Json::parse(const std::string& text) { return parse(text.data(), text.size()); }

Json Json::parse(const char* text, std::size_t size) { return Reader(text, size).whole(); }

std::string Json::dump() const {
  std::string text;
  dump_to(text);
  return text;
}

void Json::dump_to(std::string& out) const {
  switch (kind()) {
    case Kind::kNull:
      out += "null";
      break;
    case Kind::kBool:
      out += std::get<bool>(value_) ? "true" : "false";
      break;
    case Kind::kInteger:
      out += std::to_string(std::get<std::int64_t>(value_));
      break;
    case Kind::kNumber:
      write_number(out, std::get<double>(value_));
      break;
    case Kind::kString:
      write_text(out, std::get<std::string>(value_));
      break;
    case Kind::kArray: {
      const char* before = "[";
      for (const Json& one : items()) {
        out += before;
        one.dump_to(out);
        before = ",";
      }
      out += items().empty() ? "[]" : "]";
      break;
    }
    case Kind::kObject: {
      const char* before = "{";
      for (const Member& one : members()) {
        out += before;
        write_text(out, one.first);
        out += ':';
        one.second.dump_to(out);
        before = ",";
      }
      out += members().empty() ? "{}" : "}";
      break;
    }
  }
}

bool Json::as_bool(bool fallback) const {
  const bool* value = std::get_if<bool>(&value_);
  return value != nullptr ? *value : fallback;
}

std::int64_t Json::as_int(std::int64_t fallback) const {
  if (const auto* value = std::get_if<std::int64_t>(&value_)) return *value;
  const auto* value = std::get_if<double>(&value_);
  if (value == nullptr || !(std::abs(*value) < 9.2e18)) return fallback;
  return static_cast<std::int64_t>(*value);
}

double Json::as_double(double fallback) const {
  if (const auto* value = std::get_if<double>(&value_)) return *value;
  if (const auto* value = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*value);
  return fallback;
}

std::string Json::as_string(const std::string& fallback) const {
  const auto* value = std::get_if<std::string>(&value_);
  return value != nullptr ? *value : fallback;
}

std::vector<std::string> Json::as_strings() const {
  std::vector<std::string> found;
  for (const Json& one : items()) found.push_back(one.as_string());
  return found;
}

const Json::Array& Json::items() const {
  static const auto* none = new Array;
  const auto* value = std::get_if<Array>(&value_);
  return value != nullptr ? *value : *none;
}

const Json::Object& Json::members() const {
  static const auto* none = new Object;
  const auto* value = std::get_if<Object>(&value_);
  return value != nullptr ? *value : *none;
}

std::size_t Json::size() const { return is_object() ? members().size() : items().size(); }

const Json* Json::find(const std::string& key) const {
  for (const Member& one : members()) {
    if (one.first == key) return &one.second;
  }
  return nullptr;
}

const Json& Json::operator[](const std::string& key) const {
  const Json* found = find(key);
  return found != nullptr ? *found : nothing();
}

const Json& Json::operator[](std::size_t index) const {
  return index < items().size() ? items()[index] : nothing();
}

Json& Json::set(const std::string& key, Json value) {
  if (!is_object()) value_ = Object();
  for (Member& one : std::get<Object>(value_)) {
    if (one.first == key) {
      one.second = std::move(value);
      return *this;
    }
  }
  std::get<Object>(value_).emplace_back(key, std::move(value));
  return *this;
}

Json& Json::push(Json value) {
  if (!is_array()) value_ = Array();
  std::get<Array>(value_).push_back(std::move(value));
  return *this;
}

}  // namespace gazelle
