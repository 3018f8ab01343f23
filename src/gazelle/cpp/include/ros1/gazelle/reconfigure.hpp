// What configuration classes made of .cfg files have in common: their parameters as a table, and
// all that is done by it. A class adds its members and its table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <ros/node_handle.h>

namespace gazelle {
namespace reconfigure {

enum class Type { boolean, integer, real, text };

inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct Parameter {
  const char* name;
  Type type;
  std::size_t offset;  // in the configuration class
  int group;           // its number
  std::uint32_t level;
  const char* description;
  const char* edit_method;
  double value;  // default of numbers and flags, and their limits
  double lowest;
  double highest;
  const char* text;  // the same of texts
  const char* lowest_text;
  const char* highest_text;
};

struct Group {
  const char* name;
  const char* type;
  int parent;
  std::size_t state;  // where the class keeps whether it is unfolded
  bool is_unfolded;
};

struct Table {
  const Parameter* parameters;
  std::size_t parameter_count;
  const Group* groups;  // by number
  std::size_t group_count;
};

enum class Which { usual, lowest, highest };

void set_all(const Table& table, void* config, Which which);
void clamp(const Table& table, void* config);
// The levels of all parameters in which two configurations differ.
std::uint32_t level(const Table& table, const void* one, const void* other);
void to_message(const Table& table, const void* config, dynamic_reconfigure::Config& message);
// False where the message holds parameters that the class has not.
bool from_message(const Table& table, void* config, const dynamic_reconfigure::Config& message);
void to_server(const Table& table, const void* config, const ros::NodeHandle& node);
void from_server(const Table& table, void* config, const ros::NodeHandle& node);
void describe(const Table& table, dynamic_reconfigure::ConfigDescription& message);

// The service and the topics of a server.
class Endpoints {
 public:
  using Change = std::function<void(const dynamic_reconfigure::Config& request,
                                    dynamic_reconfigure::Config& response)>;

  Endpoints(ros::NodeHandle node, Change change);
  void describe(const dynamic_reconfigure::ConfigDescription& description);
  void update(const dynamic_reconfigure::Config& values);

 private:
  bool set(dynamic_reconfigure::ReconfigureRequest& request,
           dynamic_reconfigure::ReconfigureResponse& response);

  Change change_;
  ros::ServiceServer service_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
};

// What every configuration class has, by its own table.
template <class Config>
struct Configuration {
  static const Config& usual() { return made<Which::usual>(); }
  static const Config& lowest() { return made<Which::lowest>(); }
  static const Config& highest() { return made<Which::highest>(); }
  static const dynamic_reconfigure::ConfigDescription& description() {
    static const dynamic_reconfigure::ConfigDescription found = [] {
      dynamic_reconfigure::ConfigDescription message;
      const Table& table = Config::__getTable__();
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
  static const Config& made() {
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
#define GAZELLE_CONFIGURATION(Class)                                                 \
  bool __fromMessage__(const dynamic_reconfigure::Config& message) {                 \
    return ::gazelle::reconfigure::from_message(__getTable__(), this, message);      \
  }                                                                                  \
  void __toMessage__(dynamic_reconfigure::Config& message) const {                   \
    ::gazelle::reconfigure::to_message(__getTable__(), this, message);               \
  }                                                                                  \
  void __toServer__(const ros::NodeHandle& node) const {                             \
    ::gazelle::reconfigure::to_server(__getTable__(), this, node);                   \
  }                                                                                  \
  void __fromServer__(const ros::NodeHandle& node) {                                 \
    ::gazelle::reconfigure::from_server(__getTable__(), this, node);                 \
  }                                                                                  \
  void __clamp__() { ::gazelle::reconfigure::clamp(__getTable__(), this); }          \
  uint32_t __level__(const Class& other) const {                                     \
    return ::gazelle::reconfigure::level(__getTable__(), this, &other);              \
  }                                                                                  \
  static const dynamic_reconfigure::ConfigDescription& __getDescriptionMessage__() { \
    return ::gazelle::reconfigure::Configuration<Class>::description();              \
  }                                                                                  \
  static const Class& __getDefault__() {                                             \
    return ::gazelle::reconfigure::Configuration<Class>::usual();                    \
  }                                                                                  \
  static const Class& __getMax__() {                                                 \
    return ::gazelle::reconfigure::Configuration<Class>::highest();                  \
  }                                                                                  \
  static const Class& __getMin__() {                                                 \
    return ::gazelle::reconfigure::Configuration<Class>::lowest();                   \
  }
