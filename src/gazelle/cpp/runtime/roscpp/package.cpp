// Packages, by name.

#include <ros/package.h>
#include <gazelle/core.hpp>

#include <sstream>

namespace ros {
namespace package {

namespace {

using gazelle::Json;

Json ask(const char* verb, const Json& request = Json::object()) {
  try {
    return gazelle::call(verb, request);
  } catch (const gazelle::Error&) {
    return Json();  // rospack's callers get an empty answer, too
  }
}

}  // namespace

std::string getPath(const std::string& package) {
  return ask("package/path", Json::object({{"package", package}})).as_string();
}

bool getAll(V_string& packages) {
  const Json found = ask("package/all");
  for (const std::string& name : found.as_strings()) packages.push_back(name);
  return found.is_array();
}

std::string command(const std::string& command) {
  std::istringstream words(command);
  std::string verb, package;
  words >> verb >> package;
  if (verb == "find") return getPath(package);
  if (verb == "list-names") {
    V_string packages;
    getAll(packages);
    std::string text;
    for (const std::string& name : packages) text += name + "\n";
    return text;
  }
  if (verb == "depends" || verb == "depends1" || verb == "depends-on" || verb == "depends-on1") {
    std::string text;
    const Json found =
        ask("rospack/depends", Json::object({{"command", verb}, {"package", package}}));
    for (const std::string& name : found.as_strings()) text += name + "\n";
    return text;
  }
  return "";
}

void command(const std::string& command_text, V_string& output) {
  std::istringstream lines(command(command_text));
  output.clear();
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) output.push_back(line);
}

void getPlugins(const std::string& package, const std::string& attribute, M_string& plugins, bool) {
  const Json rows =
      ask("rospack/exports", Json::object({{"package", package}, {"attribute", attribute}}));
  for (const Json& found : rows.items()) plugins[found[0].as_string()] = found[1].as_string();
}

void getPlugins(const std::string& package, const std::string& attribute, V_string& plugins,
                bool force_recrawl) {
  M_string found;
  getPlugins(package, attribute, found, force_recrawl);
  plugins.clear();
  for (const auto& plugin : found) plugins.push_back(plugin.second);
}

}  // namespace package
}  // namespace ros
