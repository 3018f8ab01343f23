// Parameters in dynamic_reconfigure's Config messages, by name.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Group.h>

namespace dynamic_reconfigure {

class ConfigTools {
 public:
  static std::vector<BoolParameter>& getVectorForType(Config& set, const bool) { return set.bools; }
  static std::vector<IntParameter>& getVectorForType(Config& set, const int) { return set.ints; }
  static std::vector<StrParameter>& getVectorForType(Config& set, const std::string&) {
    return set.strs;
  }
  static std::vector<DoubleParameter>& getVectorForType(Config& set, const double) {
    return set.doubles;
  }
  static const std::vector<BoolParameter>& getVectorForType(const Config& set, const bool) {
    return set.bools;
  }
  static const std::vector<IntParameter>& getVectorForType(const Config& set, const int) {
    return set.ints;
  }
  static const std::vector<StrParameter>& getVectorForType(const Config& set, const std::string&) {
    return set.strs;
  }
  static const std::vector<DoubleParameter>& getVectorForType(const Config& set, const double) {
    return set.doubles;
  }

  static std::size_t size(const Config& message) {
    return message.bools.size() + message.ints.size() + message.strs.size() +
           message.doubles.size();
  }

  static void clear(Config& message) {
    message.bools.clear();
    message.ints.clear();
    message.strs.clear();
    message.doubles.clear();
    message.groups.clear();
  }

  template <class T>
  static bool getParameter(const Config& set, const std::string& name, T& value) {
    for (const auto& parameter : getVectorForType(set, value)) {
      if (parameter.name == name) {
        value = static_cast<T>(parameter.value);
        return true;
      }
    }
    return false;
  }

  template <class T>
  static void appendParameter(Config& set, const std::string& name, const T& value) {
    auto& all = getVectorForType(set, value);
    all.emplace_back();
    all.back().name = name;
    all.back().value = value;
  }

  template <class G, class Unused>
  static void appendGroup(Config& set, const std::string& name, int id, int parent,
                          const G& group) {
    GroupState made;
    made.name = name;
    made.state = group.state;
    made.id = id;
    made.parent = parent;
    set.groups.push_back(made);
  }
  template <class G>
  static bool getGroupState(const Config& set, const std::string& name, G& group) {
    for (const GroupState& state : set.groups) {
      if (state.name == name) {
        group.state = state.state != 0;
        return true;
      }
    }
    return false;
  }
};

}  // namespace dynamic_reconfigure
