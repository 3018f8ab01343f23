// The parameter server.

#include <ros/console.h>
#include <ros/names.h>
#include <ros/param.h>
#include <gazelle/core.hpp>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "node_state.hpp"

namespace ros {

namespace detail {

XmlRpc::XmlRpcValue valueOf(const gazelle::Json& json) {
  using gazelle::Json;
  XmlRpc::XmlRpcValue value;
  switch (json.kind()) {
    case Json::Kind::kBool:
      value = json.as_bool();
      break;
    case Json::Kind::kInteger:
      value = static_cast<int>(json.as_int());
      break;
    case Json::Kind::kNumber:
      value = json.as_double();
      break;
    case Json::Kind::kString:
      value = json.as_string();
      break;
    case Json::Kind::kArray: {
      value.setSize(static_cast<int>(json.items().size()));
      int i = 0;
      for (const Json& item : json.items()) value[i++] = valueOf(item);
      break;
    }
    case Json::Kind::kObject:
      if (json.size() == 1 && json["$bytes"].is_string()) {
        const std::string xml =
            "<value><base64>" + json["$bytes"].as_string() + "</base64></value>";
        int at = 0;
        value.fromXml(xml, &at);
        break;
      }
      value.begin();  // a table, also where it is empty
      for (const Json::Member& member : json.members())
        value[member.first] = valueOf(member.second);
      break;
    case Json::Kind::kNull:
      break;
  }
  return value;
}

gazelle::Json jsonOf(const XmlRpc::XmlRpcValue& value) {
  using gazelle::Json;
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return Json(static_cast<bool>(value));
    case XmlRpc::XmlRpcValue::TypeInt:
      return Json(static_cast<int>(value));
    case XmlRpc::XmlRpcValue::TypeDouble:
      return Json(static_cast<double>(value));
    case XmlRpc::XmlRpcValue::TypeString:
      return Json(static_cast<const std::string&>(value));
    case XmlRpc::XmlRpcValue::TypeArray: {
      Json items = Json::array();
      for (int i = 0; i < value.size(); ++i) items.push(jsonOf(value[i]));
      return items;
    }
    case XmlRpc::XmlRpcValue::TypeStruct: {
      Json members = Json::object();
      for (const auto& member : value) members.set(member.first, jsonOf(member.second));
      return members;
    }
    case XmlRpc::XmlRpcValue::TypeInvalid:
      return Json();
    case XmlRpc::XmlRpcValue::TypeDateTime:
    case XmlRpc::XmlRpcValue::TypeBase64: {
      std::ostringstream text;
      text << value;
      const bool is_time = value.getType() == XmlRpc::XmlRpcValue::TypeDateTime;
      return Json::object({{is_time ? "$datetime" : "$bytes", Json(text.str())}});
    }
  }
  return Json();
}

}  // namespace detail

namespace param {

namespace {

using gazelle::Json;
using XmlRpc::XmlRpcValue;

bool fetch(const std::string& key, XmlRpcValue& value, bool is_cached) {
  try {
    const Json found = gazelle::call(
        "param/get", Json::object({{"name", names::resolve(key)}, {"cached", is_cached}}));
    if (!found["found"].as_bool()) return false;
    value = detail::valueOf(found["value"]);
    return true;
  } catch (const gazelle::Error& error) {
    ROS_ERROR("Parameter %s cannot be read: %s", key.c_str(), error.what());
    return false;
  }
}

void store(const std::string& key, Json value) {
  try {
    gazelle::call("param/set",
                  Json::object({{"name", names::resolve(key)}, {"value", std::move(value)}}));
  } catch (const gazelle::Error& error) {
    ROS_ERROR("Parameter %s cannot be set: %s", key.c_str(), error.what());
  }
}

// What each type of C++ takes of what is stored, as getParam() does it.
bool taken(XmlRpcValue& value, XmlRpcValue& out) {
  out = value;
  return true;
}
bool taken(XmlRpcValue& value, std::string& out) {
  if (value.getType() != XmlRpcValue::TypeString) return false;
  out = static_cast<std::string&>(value);
  return true;
}
bool taken(XmlRpcValue& value, double& out) {
  if (value.getType() == XmlRpcValue::TypeInt) {
    out = static_cast<int&>(value);
    return true;
  }
  if (value.getType() != XmlRpcValue::TypeDouble) return false;
  out = static_cast<double&>(value);
  return true;
}
bool taken(XmlRpcValue& value, float& out) {
  double wide = 0.0;
  if (!taken(value, wide)) return false;
  out = static_cast<float>(wide);
  return true;
}
bool taken(XmlRpcValue& value, int& out) {
  if (value.getType() == XmlRpcValue::TypeDouble) {
    const double number = value;
    out = static_cast<int>(std::fmod(number, 1.0) < 0.5 ? std::floor(number) : std::ceil(number));
    return true;
  }
  if (value.getType() != XmlRpcValue::TypeInt) return false;
  out = static_cast<int&>(value);
  return true;
}
bool taken(XmlRpcValue& value, bool& out) {
  if (value.getType() != XmlRpcValue::TypeBoolean) return false;
  out = static_cast<bool&>(value);
  return true;
}

// Items of lists and tables are numbers of one kind or another.
bool itemTaken(XmlRpcValue& value, std::string& out) { return taken(value, out); }
template <class T>
bool itemTaken(XmlRpcValue& value, T& out) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      out = static_cast<T>(static_cast<bool&>(value));
      return true;
    case XmlRpcValue::TypeInt:
      out = static_cast<T>(static_cast<int&>(value));
      return true;
    case XmlRpcValue::TypeDouble:
      out = static_cast<T>(static_cast<double&>(value));
      return true;
    default:
      return false;
  }
}
template <class T>
bool taken(XmlRpcValue& value, std::vector<T>& out) {
  if (value.getType() != XmlRpcValue::TypeArray) return false;
  std::vector<T> items(static_cast<std::size_t>(value.size()));
  for (int i = 0; i < value.size(); ++i) {
    T item{};
    if (!itemTaken(value[i], item)) return false;
    items[static_cast<std::size_t>(i)] = item;
  }
  out.swap(items);
  return true;
}
template <class T>
bool taken(XmlRpcValue& value, std::map<std::string, T>& out) {
  if (value.getType() != XmlRpcValue::TypeStruct) return false;
  std::map<std::string, T> members;
  for (auto& member : value)
    if (!itemTaken(member.second, members[member.first])) return false;
  out.swap(members);
  return true;
}

template <class T>
bool read(const std::string& key, T& value, bool is_cached) {
  XmlRpcValue found;
  return fetch(key, found, is_cached) && taken(found, value);
}

template <class T>
Json listed(const std::vector<T>& values) {
  Json items = Json::array();
  for (const T& value : values) items.push(Json(value));
  return items;
}
Json listed(const std::vector<bool>& values) {
  Json items = Json::array();
  for (const bool value : values) items.push(Json(value));
  return items;
}
template <class T>
Json listed(const std::map<std::string, T>& values) {
  Json members = Json::object();
  for (const auto& member : values) members.set(member.first, Json(member.second));
  return members;
}

}  // namespace

#define GAZELLE_ROS_READ(Type)                                                      \
  bool get(const std::string& key, Type& value) { return read(key, value, false); } \
  bool getCached(const std::string& key, Type& value) { return read(key, value, true); }
#define GAZELLE_ROS_LISTS(Type)                                                                   \
  GAZELLE_ROS_READ(std::vector<Type>)                                                             \
  void set(const std::string& key, const std::vector<Type>& value) { store(key, listed(value)); } \
  bool get(const std::string& key, std::map<std::string, Type>& value) {                          \
    return read(key, value, false);                                                               \
  }                                                                                               \
  bool getCached(const std::string& key, std::map<std::string, Type>& value) {                    \
    return read(key, value, true);                                                                \
  }                                                                                               \
  void set(const std::string& key, const std::map<std::string, Type>& value) {                    \
    store(key, listed(value));                                                                    \
  }

GAZELLE_ROS_READ(XmlRpc::XmlRpcValue)
GAZELLE_ROS_READ(std::string)
GAZELLE_ROS_READ(double)
GAZELLE_ROS_READ(float)
GAZELLE_ROS_READ(int)
GAZELLE_ROS_READ(bool)
GAZELLE_ROS_LISTS(std::string)
GAZELLE_ROS_LISTS(double)
GAZELLE_ROS_LISTS(float)
GAZELLE_ROS_LISTS(int)
GAZELLE_ROS_LISTS(bool)

void set(const std::string& key, const XmlRpcValue& value) { store(key, detail::jsonOf(value)); }
void set(const std::string& key, const std::string& value) { store(key, Json(value)); }
void set(const std::string& key, const char* value) { store(key, Json(value)); }
void set(const std::string& key, double value) { store(key, Json(value)); }
void set(const std::string& key, int value) { store(key, Json(value)); }
void set(const std::string& key, bool value) { store(key, Json(value)); }

bool has(const std::string& key) {
  return gazelle::call("param/has", Json::object({{"name", names::resolve(key)}})).as_bool();
}
bool del(const std::string& key) {
  return gazelle::call("param/delete", Json::object({{"name", names::resolve(key)}})).as_bool();
}
bool search(const std::string& ns, const std::string& key, std::string& result) {
  const Json found =
      gazelle::call("param/search", Json::object({{"namespace", ns}, {"name", key}}));
  if (!found.is_string()) return false;
  result = found.as_string();
  return true;
}
bool search(const std::string& key, std::string& result) {
  return search(names::resolve("~"), key, result);
}
bool getParamNames(std::vector<std::string>& keys) {
  keys = gazelle::call("param/names").as_strings();
  return true;
}
void unsubscribeCachedParam(const std::string&) {}
void unsubscribeCachedParam() {}

void init(const M_string& remappings) {
  for (const auto& pair : remappings) {
    const std::string& name = pair.first;
    const std::string& text = pair.second;
    if (name.size() < 2 || name[0] != '_' || name[1] == '_') continue;
    const std::string key = "~" + name.substr(1);
    // What the text looks like is what it is: a whole number, a number, yes or no, else a text.
    char* end = nullptr;
    errno = 0;
    const long whole = std::strtol(text.c_str(), &end, 10);
    if (!text.empty() && *end == 0 && errno == 0 && whole == static_cast<int>(whole)) {
      set(key, static_cast<int>(whole));
      continue;
    }
    const double number = std::strtod(text.c_str(), &end);
    if (!text.empty() && *end == 0)
      set(key, number);
    else if (text == "True" || text == "true" || text == "TRUE")
      set(key, true);
    else if (text == "False" || text == "false" || text == "FALSE")
      set(key, false);
    else
      set(key, text);
  }
}

}  // namespace param
}  // namespace ros
