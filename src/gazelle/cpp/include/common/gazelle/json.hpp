// JSON values: what verbs of the host take and give.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "gazelle/export.hpp"

namespace gazelle {

// A JSON value. Objects keep the order of their members; whole numbers stay whole.
class GAZELLE_EXPORT Json {
 public:
  using Array = std::vector<Json>;
  using Member = std::pair<std::string, Json>;
  using Object = std::vector<Member>;
  enum class Kind { kNull, kBool, kInteger, kNumber, kString, kArray, kObject };

  Json() = default;
  Json(std::nullptr_t) {}                                                       // NOLINT: a value
  Json(bool value) : value_(value) {}                                           // NOLINT
  Json(int value) : value_(static_cast<std::int64_t>(value)) {}                 // NOLINT
  Json(unsigned value) : value_(static_cast<std::int64_t>(value)) {}            // NOLINT
  Json(long value) : value_(static_cast<std::int64_t>(value)) {}                // NOLINT
  Json(unsigned long value) : value_(static_cast<std::int64_t>(value)) {}       // NOLINT
  Json(long long value) : value_(static_cast<std::int64_t>(value)) {}           // NOLINT
  Json(unsigned long long value) : value_(static_cast<std::int64_t>(value)) {}  // NOLINT
  Json(double value) : value_(value) {}                                         // NOLINT
  Json(const char* value) : value_(std::string(value)) {}                       // NOLINT
  Json(std::string value) : value_(std::move(value)) {}                         // NOLINT
  Json(Array value) : value_(std::move(value)) {}                               // NOLINT
  Json(Object value) : value_(std::move(value)) {}                              // NOLINT
  template <class T>
  Json(const std::vector<T>& values) : value_(Array(values.begin(), values.end())) {}  // NOLINT

  static Json object(std::initializer_list<Member> members = {}) { return Json(Object(members)); }
  static Json array(std::initializer_list<Json> items = {}) { return Json(Array(items)); }

  // Throw gazelle::Error where the text is no JSON. NaN and Infinity are read and written as
  // Python does it.
  static Json parse(const std::string& text);
  static Json parse(const char* text, std::size_t size);
  std::string dump() const;
  void dump_to(std::string& text) const;

  Kind kind() const { return static_cast<Kind>(value_.index()); }
  bool is_null() const { return kind() == Kind::kNull; }
  bool is_bool() const { return kind() == Kind::kBool; }
  bool is_integer() const { return kind() == Kind::kInteger; }
  bool is_number() const { return kind() == Kind::kInteger || kind() == Kind::kNumber; }
  bool is_string() const { return kind() == Kind::kString; }
  bool is_array() const { return kind() == Kind::kArray; }
  bool is_object() const { return kind() == Kind::kObject; }

  // The value, the fallback where it is of another kind.
  bool as_bool(bool fallback = false) const;
  std::int64_t as_int(std::int64_t fallback = 0) const;  // whole numbers, and others cut off
  double as_double(double fallback = 0.0) const;
  std::string as_string(const std::string& fallback = "") const;
  std::vector<std::string> as_strings() const;
  const Array& items() const;     // none where it is no array
  const Object& members() const;  // none where it is no object

  std::size_t size() const;
  const Json* find(const std::string& key) const;
  bool has(const std::string& key) const { return find(key) != nullptr; }
  // A member or an item; null where there is none.
  const Json& operator[](const std::string& key) const;
  const Json& operator[](const char* key) const { return (*this)[std::string(key)]; }
  const Json& operator[](std::size_t index) const;
  const Json& operator[](int index) const { return (*this)[static_cast<std::size_t>(index)]; }

  // Make it an object or an array, if it is none, and put something in.
  Json& set(const std::string& key, Json value);
  Json& push(Json value);

  friend bool operator==(const Json& a, const Json& b) { return a.value_ == b.value_; }
  friend bool operator!=(const Json& a, const Json& b) { return !(a == b); }

 private:
  std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Object> value_;
};

}  // namespace gazelle
