// Values of parameters and how they are written.
#include "rclcpp/parameter.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "gazelle/core.hpp"
#include "parameter_json.hpp"
#include "rclcpp/parameter_events_filter.hpp"
#include "rclcpp/parameter_map.hpp"

namespace rclcpp {

std::string to_string(ParameterType type) {
  switch (type) {
    case PARAMETER_NOT_SET:
      return "not set";
    case PARAMETER_BOOL:
      return "bool";
    case PARAMETER_INTEGER:
      return "integer";
    case PARAMETER_DOUBLE:
      return "double";
    case PARAMETER_STRING:
      return "string";
    case PARAMETER_BYTE_ARRAY:
      return "byte_array";
    case PARAMETER_BOOL_ARRAY:
      return "bool_array";
    case PARAMETER_INTEGER_ARRAY:
      return "integer_array";
    case PARAMETER_DOUBLE_ARRAY:
      return "double_array";
    case PARAMETER_STRING_ARRAY:
      return "string_array";
  }
  return "unknown type";
}

std::ostream& operator<<(std::ostream& out, ParameterType type) { return out << to_string(type); }

ParameterValue::ParameterValue(const rcl_interfaces::msg::ParameterValue& value) : value_(value) {
  if (value.type > PARAMETER_STRING_ARRAY) {
    throw std::runtime_error("Unknown type: " + std::to_string(value.type));
  }
}
ParameterValue::ParameterValue(bool value) {
  value_.bool_value = value;
  value_.type = PARAMETER_BOOL;
}
ParameterValue::ParameterValue(int64_t value) {
  value_.integer_value = value;
  value_.type = PARAMETER_INTEGER;
}
ParameterValue::ParameterValue(double value) {
  value_.double_value = value;
  value_.type = PARAMETER_DOUBLE;
}
ParameterValue::ParameterValue(const std::string& value) {
  value_.string_value = value;
  value_.type = PARAMETER_STRING;
}
ParameterValue::ParameterValue(const std::vector<uint8_t>& value) {
  value_.byte_array_value = value;
  value_.type = PARAMETER_BYTE_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<bool>& value) {
  value_.bool_array_value = value;
  value_.type = PARAMETER_BOOL_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<int>& value) {
  value_.integer_array_value.assign(value.begin(), value.end());
  value_.type = PARAMETER_INTEGER_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<int64_t>& value) {
  value_.integer_array_value = value;
  value_.type = PARAMETER_INTEGER_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<float>& value) {
  value_.double_array_value.assign(value.begin(), value.end());
  value_.type = PARAMETER_DOUBLE_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<double>& value) {
  value_.double_array_value = value;
  value_.type = PARAMETER_DOUBLE_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<std::string>& value) {
  value_.string_array_value = value;
  value_.type = PARAMETER_STRING_ARRAY;
}

namespace {

template <class Items, class Write>
std::string listed(const Items& items, Write write) {
  std::ostringstream text;
  text << "[";
  bool first = true;
  for (const auto& one : items) {
    if (!first) text << ", ";
    write(text, one);
    first = false;
  }
  text << "]";
  return text.str();
}

}  // namespace

std::string to_string(const ParameterValue& value) {
  const auto plain = [](std::ostream& out, const auto& one) { out << one; };
  switch (value.get_type()) {
    case PARAMETER_NOT_SET:
      return "not set";
    case PARAMETER_BOOL:
      return value.get<bool>() ? "true" : "false";
    case PARAMETER_INTEGER:
      return std::to_string(value.get<int64_t>());
    case PARAMETER_DOUBLE:
      return std::to_string(value.get<double>());
    case PARAMETER_STRING:
      return value.get<std::string>();
    case PARAMETER_BYTE_ARRAY:
      return listed(value.get<std::vector<uint8_t>>(), [](std::ostream& out, uint8_t one) {
        char text[8];
        std::snprintf(text, sizeof(text), "0x%02x", one);
        out << text;
      });
    case PARAMETER_BOOL_ARRAY:
      return listed(value.get<std::vector<bool>>(),
                    [](std::ostream& out, bool one) { out << (one ? "true" : "false"); });
    case PARAMETER_INTEGER_ARRAY:
      return listed(value.get<std::vector<int64_t>>(), plain);
    case PARAMETER_DOUBLE_ARRAY:
      return listed(value.get<std::vector<double>>(), plain);
    case PARAMETER_STRING_ARRAY:
      return listed(value.get<std::vector<std::string>>(), plain);
  }
  return "unknown type";
}

Parameter Parameter::from_parameter_msg(const rcl_interfaces::msg::Parameter& message) {
  return Parameter(message.name, ParameterValue(message.value));
}

rcl_interfaces::msg::Parameter Parameter::to_parameter_msg() const {
  rcl_interfaces::msg::Parameter message;
  message.name = name_;
  message.value = value_.to_value_msg();
  return message;
}

std::string _to_json_dict_entry(const Parameter& parameter) {
  return "\"" + parameter.get_name() + "\": {\"type\": \"" + parameter.get_type_name() +
         "\", \"value\": \"" + parameter.value_to_string() + "\"}";
}

std::ostream& operator<<(std::ostream& out, const Parameter& parameter) {
  return out << std::to_string(parameter);
}

std::ostream& operator<<(std::ostream& out, const std::vector<Parameter>& parameters) {
  return out << std::to_string(parameters);
}

ParameterEventsFilter::ParameterEventsFilter(
    std::shared_ptr<const rcl_interfaces::msg::ParameterEvent> event,
    const std::vector<std::string>& names, const std::vector<EventType>& types)
    : event_(std::move(event)) {
  const auto wants = [&types](EventType type) {
    return std::find(types.begin(), types.end(), type) != types.end();
  };
  const auto take = [&](const auto& parameters, EventType type) {
    if (!wants(type)) return;
    for (const auto& one : parameters) {
      if (names.empty() || std::find(names.begin(), names.end(), one.name) != names.end()) {
        result_.push_back({type, &one});
      }
    }
  };
  take(event_->new_parameters, EventType::NEW);
  take(event_->changed_parameters, EventType::CHANGED);
  take(event_->deleted_parameters, EventType::DELETED);
}

namespace detail {

ParameterValue value_from_json(const gazelle::Json& json) {
  using Kind = gazelle::Json::Kind;
  switch (json.kind()) {
    case Kind::kBool:
      return ParameterValue(json.as_bool());
    case Kind::kInteger:
      return ParameterValue(json.as_int());
    case Kind::kNumber:
      return ParameterValue(json.as_double());
    case Kind::kString:
      return ParameterValue(json.as_string());
    case Kind::kArray:
      break;
    default:
      return ParameterValue();
  }
  const auto& items = json.items();
  const auto all = [&items](auto is) { return std::all_of(items.begin(), items.end(), is); };
  if (items.empty()) return ParameterValue(std::vector<std::string>());
  if (all([](const gazelle::Json& one) { return one.is_bool(); })) {
    std::vector<bool> values;
    for (const auto& one : items) values.push_back(one.as_bool());
    return ParameterValue(values);
  }
  if (all([](const gazelle::Json& one) { return one.is_integer(); })) {
    std::vector<int64_t> values;
    for (const auto& one : items) values.push_back(one.as_int());
    return ParameterValue(values);
  }
  if (all([](const gazelle::Json& one) { return one.is_number(); })) {
    std::vector<double> values;
    for (const auto& one : items) values.push_back(one.as_double());
    return ParameterValue(values);
  }
  std::vector<std::string> values;
  for (const auto& one : items) values.push_back(one.as_string());
  return ParameterValue(values);
}

}  // namespace detail

ParameterMap parameter_map_from_yaml_file(const std::string& yaml_filename, const char* node_fqn) {
  ParameterMap map;
  gazelle::Json found;
  try {
    const std::string node = node_fqn ? node_fqn : "/**";
    found = gazelle::call("rclcpp/parameter_file",
                          gazelle::Json::object({{"path", yaml_filename}, {"node", node}}));
  } catch (const gazelle::Error& error) {
    throw exceptions::InvalidParametersException(error.what());
  }
  for (const auto& node : found.members()) {
    if (node_fqn && node.first != node_fqn && node.first != "/**") continue;
    auto& rows = map[node.first];
    for (const auto& one : node.second.members()) {
      rows.emplace_back(one.first, detail::value_from_json(one.second));
    }
  }
  return map;
}

std::vector<Parameter> parameters_from_map(const ParameterMap& map, const char* node_fqn) {
  std::vector<Parameter> parameters;
  for (const auto& node : map) {
    if (node_fqn && node.first != node_fqn && node.first != "/**") continue;
    parameters.insert(parameters.end(), node.second.begin(), node.second.end());
  }
  return parameters;
}

}  // namespace rclcpp

namespace std {

std::string to_string(const rclcpp::Parameter& parameter) {
  return "{\"name\": \"" + parameter.get_name() + "\", \"type\": \"" + parameter.get_type_name() +
         "\", \"value\": \"" + parameter.value_to_string() + "\"}";
}

std::string to_string(const std::vector<rclcpp::Parameter>& parameters) {
  std::string text = "{";
  for (const auto& one : parameters) {
    if (text.size() > 1) text += ", ";
    text += rclcpp::_to_json_dict_entry(one);
  }
  return text + "}";
}

}  // namespace std
