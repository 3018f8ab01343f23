// Names of the graph by ROS 1's rules, and the name of this node.

#include <ros/exceptions.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/this_node.h>

#include <cctype>
#include <cstdlib>

#include "node_state.hpp"

namespace ros {

namespace {

struct Naming {
  std::string name = "/";  // this node's, global
  std::string namespace_;
  M_string remappings;
  M_string unresolved;
};

Naming& naming() {
  static Naming* const state = new Naming;  // callbacks may ask to the very end
  return *state;
}

}  // namespace

namespace names {

bool validate(const std::string& name, std::string& error) {
  if (name.empty()) return true;
  const unsigned char first = static_cast<unsigned char>(name[0]);
  if (!std::isalpha(first) && first != '/' && first != '~') {
    error = std::string("'") + name[0] + "' may not be the first character of the name '" + name +
            "': it begins with a letter, / or ~";
    return false;
  }
  for (std::size_t i = 1; i < name.size(); ++i) {
    const unsigned char c = static_cast<unsigned char>(name[i]);
    if (!std::isalnum(c) && c != '/' && c != '_') {
      error = std::string("'") + name[i] + "' at place " + std::to_string(i) + " of the name '" +
              name + "' is none of 0-9, a-z, A-Z, / and _";
      return false;
    }
  }
  return true;
}

std::string clean(const std::string& name) {
  std::string cleaned;
  for (const char c : name)
    if (c != '/' || cleaned.empty() || cleaned.back() != '/') cleaned += c;
  if (!cleaned.empty() && cleaned.back() == '/') cleaned.pop_back();
  return cleaned;
}

std::string append(const std::string& left, const std::string& right) {
  return clean(left + "/" + right);
}

std::string remap(const std::string& name) {
  const std::string global = resolve(name, false);
  const M_string::const_iterator found = naming().remappings.find(global);
  return found == naming().remappings.end() ? name : found->second;
}

std::string resolve(const std::string& name, bool remap) {
  return resolve(this_node::getNamespace(), name, remap);
}

std::string resolve(const std::string& ns, const std::string& name, bool remap) {
  std::string error;
  if (!validate(name, error)) throw InvalidNameException(error);
  if (name.empty()) {
    if (ns.empty()) return "/";
    return ns[0] == '/' ? ns : append("/", ns);
  }
  std::string global = name;
  if (global[0] == '~') global = append(this_node::getName(), global.substr(1));
  if (global[0] != '/') global = append("/", append(ns, global));
  global = clean(global);
  return remap ? names::remap(global) : global;
}

const M_string& getRemappings() { return naming().remappings; }
const M_string& getUnresolvedRemappings() { return naming().unresolved; }

std::string parentNamespace(const std::string& name) {
  std::string error;
  if (!validate(name, error)) throw InvalidNameException(error);
  if (name.empty()) return "";
  if (name == "/") return "/";
  const std::string stripped = name.back() == '/' ? name.substr(0, name.size() - 1) : name;
  const std::size_t slash = stripped.rfind('/');
  if (slash == std::string::npos) return "";
  return slash == 0 ? "/" : stripped.substr(0, slash);
}

void init(const M_string& remappings) {
  for (const auto& pair : remappings) {
    const std::string& left = pair.first;
    if (left.empty() || left[0] == '_' || left == this_node::getName()) continue;
    naming().remappings[resolve(left, false)] = resolve(pair.second, false);
    naming().unresolved[left] = pair.second;
  }
}

}  // namespace names

namespace this_node {

const std::string& getName() { return naming().name; }
const std::string& getNamespace() { return naming().namespace_; }

void init(const std::string& name, const M_string& remappings, uint32_t options) {
  if (name.empty()) throw InvalidNameException("The node name must not be empty");
  Naming& state = naming();
  std::string base = name;
  bool is_anonymous = (options & init_options::AnonymousName) != 0;
  const auto given = remappings.find("__name");
  if (given != remappings.end()) {
    base = given->second;
    is_anonymous = false;
  }
  const auto space = remappings.find("__ns");
  if (space != remappings.end()) {
    state.namespace_ = space->second;
  } else if (const char* variable = std::getenv("ROS_NAMESPACE")) {
    state.namespace_ = variable;
  }
  state.namespace_ = names::clean("/" + state.namespace_);
  if (state.namespace_.empty()) state.namespace_ = "/";

  std::string error;
  if (!names::validate(state.namespace_, error))
    throw InvalidNameException("Namespace [" + state.namespace_ + "] is invalid: " + error);
  if (base.find('/') != std::string::npos)
    throw InvalidNodeNameException(base, "node names cannot contain /");
  if (base.find('~') != std::string::npos)
    throw InvalidNodeNameException(base, "node names cannot contain ~");
  // Remappings are relative to the namespace alone: they are there before the name is.
  names::init(remappings);
  state.name = names::resolve(state.namespace_, base, true);
  if (is_anonymous) state.name += "_" + std::to_string(WallTime::now().toNSec());
}

}  // namespace this_node
}  // namespace ros
