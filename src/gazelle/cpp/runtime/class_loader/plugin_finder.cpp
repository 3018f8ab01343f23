// pluginlib: what packages declare, by the verbs plugins/declared and plugins/library.
#include <algorithm>

#include "gazelle/core.hpp"
#include "gazelle/json.hpp"
#include "gazelle/plugins/plugin_loader.hpp"

namespace pluginlib {
namespace detail {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace

std::string name_without_package(const std::string& lookup_name) {
  const auto colons = lookup_name.rfind("::");
  if (colons != std::string::npos) return lookup_name.substr(colons + 2);
  const auto slash = lookup_name.rfind('/');
  return slash == std::string::npos ? lookup_name : lookup_name.substr(slash + 1);
}

PluginFinder::PluginFinder(const std::string& package, const std::string& base_class,
                           const std::string& attribute, const std::vector<std::string>& xml_paths)
    : package_(package), base_class_(base_class), attribute_(attribute), given_paths_(xml_paths) {
  refresh();
}

void PluginFinder::refresh() {
  gazelle::Json request = gazelle::Json::object(
      {{"package", package_}, {"base", base_class_}, {"attribute", attribute_}});
  request.set("xml_paths", gazelle::Json(given_paths_));
  gazelle::Json found;
  try {
    found = gazelle::call("plugins/declared", request);
  } catch (const std::runtime_error& error) {
    throw ClassLoaderException(error.what());
  }
  if (found.has("error")) throw InvalidXMLException(found["error"].as_string());
  xml_paths_ = found["xml_paths"].as_strings();
  // What is loaded stays as it was declared when it was loaded.
  for (auto entry = classes_.begin(); entry != classes_.end();) {
    entry = is_loaded(entry->first) ? std::next(entry) : classes_.erase(entry);
  }
  for (const auto& item : found["classes"].items()) {
    const std::string name = item["name"].as_string();
    classes_.emplace(name, ClassDesc(name, item["type"].as_string(), base_class_,
                                     item["package"].as_string(), item["description"].as_string(),
                                     item["library"].as_string(), item["manifest"].as_string()));
  }
}

const ClassDesc& PluginFinder::description(const std::string& lookup_name) const {
  const auto found = classes_.find(lookup_name);
  if (found != classes_.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : classes_) names.push_back(entry.first);
  throw LibraryLoadException("According to the loaded plugin descriptions the class " +
                             lookup_name + " with base class type " + base_class_ +
                             " does not exist. Declared types are  " + joined(names));
}

std::string PluginFinder::library_path(const std::string& lookup_name) {
  auto& desc = const_cast<ClassDesc&>(description(lookup_name));
  if (desc.resolved_library_path_ != "UNRESOLVED") return desc.resolved_library_path_;
  const auto request = gazelle::Json::object({{"package", desc.package_},
                                              {"library", desc.library_name_},
                                              {"manifest", desc.plugin_manifest_path_}});
  gazelle::Json found;
  try {
    found = gazelle::call("plugins/library", request);
  } catch (const std::runtime_error& error) {
    throw LibraryLoadException("Could not find library corresponding to plugin " + lookup_name +
                               ": " + error.what());
  }
  desc.resolved_library_path_ = found["path"].as_string();
  return desc.resolved_library_path_;
}

void PluginFinder::load(const std::string& lookup_name) {
  const std::string path = library_path(lookup_name);
  if (path.empty()) {
    throw LibraryLoadException("Could not find library corresponding to plugin " + lookup_name +
                               ". Make sure the plugin description XML file has the correct "
                               "name of the library and that the library actually exists.");
  }
  try {
    gazelle::load_library(path);
  } catch (const std::runtime_error& error) {
    throw LibraryLoadException("Failed to load library " + path + ": " + error.what());
  }
  ++loaded_[lookup_name];
}

int PluginFinder::unload(const std::string& lookup_name) {
  description(lookup_name);
  const auto found = loaded_.find(lookup_name);
  if (found == loaded_.end()) return 0;
  if (--found->second > 0) return found->second;
  loaded_.erase(found);
  return 0;
}

bool PluginFinder::is_loaded(const std::string& lookup_name) const {
  return loaded_.count(lookup_name) != 0;
}

std::vector<std::string> PluginFinder::libraries() const {
  std::vector<std::string> found;
  for (const auto& entry : classes_) {
    const std::string& path = entry.second.resolved_library_path_;
    if (path == "UNRESOLVED" || !is_loaded(entry.first)) continue;
    if (std::find(found.begin(), found.end(), path) == found.end()) found.push_back(path);
  }
  return found;
}

void* PluginFinder::create(const std::string& lookup_name, const char* base, bool auto_load) {
  const ClassDesc& desc = description(lookup_name);
  if (!is_loaded(lookup_name) && auto_load) load(lookup_name);
  const std::string path = library_path(lookup_name);
  auto& registry = gazelle::ClassRegistry::instance();
  const std::string library = gazelle::library_identity(path);
  void* made = registry.create(desc.derived_class_, base, library);
  if (made != nullptr) return made;
  throw CreateClassException("Failed to create an instance of " + lookup_name + ": library " +
                             path + " has registered no class " + desc.derived_class_ +
                             " with base class " + base_class_ +
                             " (it has: " + joined(registry.names(base, library)) +
                             "); see the macro PLUGINLIB_EXPORT_CLASS and attribute type of " +
                             desc.plugin_manifest_path_);
}

}  // namespace detail
}  // namespace pluginlib
