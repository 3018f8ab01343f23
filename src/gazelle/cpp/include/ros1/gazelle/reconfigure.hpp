// What configuration classes made of .cfg files have in common: their parameters as a table, and
// all that is done by it. A class adds its members and its table.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/config_tools.h>
#include <ros/node_handle.h>

namespace gazelle {
namespace reconfigure {

enum class Type { boolean, integer, real, text };

inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct Parameter {
  const char *name;
  Type type;
  std::size_t offset;  // in the configuration class
  int group;           // its number
  std::uint32_t level;
  const char *description;
  const char *edit_method;
  double value;  // default of numbers and flags, and their limits
  double lowest;
  double highest;
  const char *text;  // the same of texts
  const char *lowest_text;
  const char *highest_text;
};

struct Group {
  const char *name;
  const char *type;
  int parent;
  std::size_t state;  // where the class keeps whether it is unfolded
  bool is_unfolded;
};

struct Table {
  const Parameter *parameters;
  std::size_t parameter_count;
  const Group *groups;  // by number
  std::size_t group_count;
};

template <class T>
T &at(void *config, std::size_t offset) {
  return *reinterpret_cast<T *>(static_cast<char *>(config) + offset);
}
template <class T>
const T &at(const void *config, std::size_t offset) {
  return *reinterpret_cast<const T *>(static_cast<const char *>(config) + offset);
}

enum class Which { usual, lowest, highest };

inline void set_all(const Table &table, void *config, Which which) {
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter &row = table.parameters[i];
    const double value = which == Which::usual    ? row.value
                         : which == Which::lowest ? row.lowest
                                                  : row.highest;
    switch (row.type) {
      case Type::boolean:
        at<bool>(config, row.offset) = value != 0;
        break;
      case Type::integer:
        at<int>(config, row.offset) = static_cast<int>(value);
        break;
      case Type::real:
        at<double>(config, row.offset) = value;
        break;
      case Type::text:
        at<std::string>(config, row.offset) = which == Which::usual    ? row.text
                                              : which == Which::lowest ? row.lowest_text
                                                                       : row.highest_text;
        break;
    }
  }
  for (std::size_t i = 0; i < table.group_count; ++i) {
    at<bool>(config, table.groups[i].state) = table.groups[i].is_unfolded;
  }
}

inline void clamp(const Table &table, void *config) {
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter &row = table.parameters[i];
    if (row.type == Type::integer) {
      int &value = at<int>(config, row.offset);
      value = value > row.highest ? static_cast<int>(row.highest) : value;
      value = value < row.lowest ? static_cast<int>(row.lowest) : value;
    } else if (row.type == Type::real) {
      double &value = at<double>(config, row.offset);
      value = value > row.highest ? row.highest : value;
      value = value < row.lowest ? row.lowest : value;
    }
  }
}

// The levels of all parameters in which two configurations differ.
inline std::uint32_t level(const Table &table, const void *one, const void *other) {
  std::uint32_t found = 0;
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter &row = table.parameters[i];
    bool is_same = true;
    switch (row.type) {
      case Type::boolean:
        is_same = at<bool>(one, row.offset) == at<bool>(other, row.offset);
        break;
      case Type::integer:
        is_same = at<int>(one, row.offset) == at<int>(other, row.offset);
        break;
      case Type::real:
        is_same = at<double>(one, row.offset) == at<double>(other, row.offset);
        break;
      case Type::text:
        is_same = at<std::string>(one, row.offset) == at<std::string>(other, row.offset);
        break;
    }
    if (!is_same) {
      found |= row.level;
    }
  }
  return found;
}

inline void to_message(const Table &table, const void *config,
                       dynamic_reconfigure::Config &message) {
  using dynamic_reconfigure::ConfigTools;
  ConfigTools::clear(message);
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter &row = table.parameters[i];
    switch (row.type) {
      case Type::boolean:
        ConfigTools::appendParameter(message, row.name, at<bool>(config, row.offset));
        break;
      case Type::integer:
        ConfigTools::appendParameter(message, row.name, at<int>(config, row.offset));
        break;
      case Type::real:
        ConfigTools::appendParameter(message, row.name, at<double>(config, row.offset));
        break;
      case Type::text:
        ConfigTools::appendParameter(message, row.name, at<std::string>(config, row.offset));
        break;
    }
  }
  for (std::size_t i = 0; i < table.group_count; ++i) {
    const Group &group = table.groups[i];
    dynamic_reconfigure::GroupState state;
    state.name = group.name;
    state.state = at<bool>(config, group.state);
    state.id = static_cast<int>(i);
    state.parent = group.parent;
    message.groups.push_back(state);
  }
}

// False where the message holds parameters that the class has not.
inline bool from_message(const Table &table, void *config,
                         const dynamic_reconfigure::Config &message) {
  using dynamic_reconfigure::ConfigTools;
  std::size_t count = 0;
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter &row = table.parameters[i];
    bool is_there = false;
    switch (row.type) {
      case Type::boolean:
        is_there = ConfigTools::getParameter(message, row.name, at<bool>(config, row.offset));
        break;
      case Type::integer:
        is_there = ConfigTools::getParameter(message, row.name, at<int>(config, row.offset));
        break;
      case Type::real:
        is_there = ConfigTools::getParameter(message, row.name, at<double>(config, row.offset));
        break;
      case Type::text:
        is_there =
            ConfigTools::getParameter(message, row.name, at<std::string>(config, row.offset));
        break;
    }
    count += is_there ? 1 : 0;
  }
  for (const dynamic_reconfigure::GroupState &state : message.groups) {
    for (std::size_t i = 0; i < table.group_count; ++i) {
      if (state.name == table.groups[i].name) {
        at<bool>(config, table.groups[i].state) = state.state != 0;
      }
    }
  }
  return count == ConfigTools::size(message);
}

inline void to_server(const Table &table, const void *config, const ros::NodeHandle &node) {
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter &row = table.parameters[i];
    switch (row.type) {
      case Type::boolean:
        node.setParam(row.name, at<bool>(config, row.offset));
        break;
      case Type::integer:
        node.setParam(row.name, at<int>(config, row.offset));
        break;
      case Type::real:
        node.setParam(row.name, at<double>(config, row.offset));
        break;
      case Type::text:
        node.setParam(row.name, at<std::string>(config, row.offset));
        break;
    }
  }
}

inline void from_server(const Table &table, void *config, const ros::NodeHandle &node) {
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter &row = table.parameters[i];
    switch (row.type) {
      case Type::boolean:
        node.getParam(row.name, at<bool>(config, row.offset));
        break;
      case Type::integer:
        node.getParam(row.name, at<int>(config, row.offset));
        break;
      case Type::real:
        node.getParam(row.name, at<double>(config, row.offset));
        break;
      case Type::text:
        node.getParam(row.name, at<std::string>(config, row.offset));
        break;
    }
  }
}

inline const char *type_name(Type type) {
  switch (type) {
    case Type::boolean:
      return "bool";
    case Type::integer:
      return "int";
    case Type::real:
      return "double";
    default:
      return "str";
  }
}

inline void describe(const Table &table, dynamic_reconfigure::ConfigDescription &message) {
  for (std::size_t number = 0; number < table.group_count; ++number) {
    const Group &group = table.groups[number];
    dynamic_reconfigure::Group made;
    made.name = group.name;
    made.type = group.type;
    made.id = static_cast<int>(number);
    made.parent = group.parent;
    for (std::size_t i = 0; i < table.parameter_count; ++i) {
      const Parameter &row = table.parameters[i];
      if (row.group == static_cast<int>(number)) {
        dynamic_reconfigure::ParamDescription parameter;
        parameter.name = row.name;
        parameter.type = type_name(row.type);
        parameter.level = row.level;
        parameter.description = row.description;
        parameter.edit_method = row.edit_method;
        made.parameters.push_back(parameter);
      }
    }
    message.groups.push_back(made);
  }
}

// What every configuration class has, by its own table.
template <class Config>
struct Configuration {
  static const Config &usual() { return made<Which::usual>(); }
  static const Config &lowest() { return made<Which::lowest>(); }
  static const Config &highest() { return made<Which::highest>(); }
  static const dynamic_reconfigure::ConfigDescription &description() {
    static const dynamic_reconfigure::ConfigDescription found = [] {
      dynamic_reconfigure::ConfigDescription message;
      const Table &table = Config::__getTable__();
      describe(table, message);
      to_message(table, &highest(), message.max);
      to_message(table, &lowest(), message.min);
      to_message(table, &usual(), message.dflt);
      return message;
    }();
    return found;
  }

 private:
  template <Which which>
  static const Config &made() {
    static const Config found = [] {
      Config config;
      set_all(Config::__getTable__(), &config, which);
      return config;
    }();
    return found;
  }
};

}  // namespace reconfigure
}  // namespace gazelle

// The functions that roscpp programs call on a configuration class.
#define GAZELLE_CONFIGURATION(Class)                                                               \
  bool __fromMessage__(const dynamic_reconfigure::Config &message) {                               \
    return ::gazelle::reconfigure::from_message(__getTable__(), this, message);                    \
  }                                                                                                \
  void __toMessage__(dynamic_reconfigure::Config &message) const {                                 \
    ::gazelle::reconfigure::to_message(__getTable__(), this, message);                             \
  }                                                                                                \
  void __toServer__(const ros::NodeHandle &node) const {                                           \
    ::gazelle::reconfigure::to_server(__getTable__(), this, node);                                 \
  }                                                                                                \
  void __fromServer__(const ros::NodeHandle &node) {                                               \
    ::gazelle::reconfigure::from_server(__getTable__(), this, node);                               \
  }                                                                                                \
  void __clamp__() { ::gazelle::reconfigure::clamp(__getTable__(), this); }                        \
  uint32_t __level__(const Class &other) const {                                                   \
    return ::gazelle::reconfigure::level(__getTable__(), this, &other);                            \
  }                                                                                                \
  static const dynamic_reconfigure::ConfigDescription &__getDescriptionMessage__() {               \
    return ::gazelle::reconfigure::Configuration<Class>::description();                            \
  }                                                                                                \
  static const Class &__getDefault__() {                                                           \
    return ::gazelle::reconfigure::Configuration<Class>::usual();                                  \
  }                                                                                                \
  static const Class &__getMax__() {                                                               \
    return ::gazelle::reconfigure::Configuration<Class>::highest();                                \
  }                                                                                                \
  static const Class &__getMin__() {                                                               \
    return ::gazelle::reconfigure::Configuration<Class>::lowest();                                 \
  }
