#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

#include "class_loader/class_loader.hpp"
#include "gazelle/class_registry.hpp"
#include "gazelle/plugin_pointer.hpp"
#include "pluginlib/class_desc.hpp"
#include "pluginlib/class_loader_base.hpp"
#include "pluginlib/exceptions.hpp"

namespace pluginlib {

template <typename T>
using UniquePtr = std::unique_ptr<T, std::function<void(T*)>>;

namespace detail {

// Everything of a loader that does not depend on what it makes: the descriptions that packages
// export, the libraries, the words of its errors.
class PluginFinder {
 public:
  PluginFinder(const std::string& package, const std::string& base_class,
               const std::string& attribute, const std::vector<std::string>& xml_paths);

  void refresh();
  const std::map<std::string, ClassDesc>& classes() const { return classes_; }
  const std::vector<std::string>& xml_paths() const { return xml_paths_; }
  const std::string& base_class() const { return base_class_; }

  // Throws LibraryLoadException where no description has the class.
  const ClassDesc& description(const std::string& lookup_name) const;
  // The library of a class, compiled first where it is source; empty where there is none.
  std::string library_path(const std::string& lookup_name);
  void load(const std::string& lookup_name);
  int unload(const std::string& lookup_name);
  bool is_loaded(const std::string& lookup_name) const;
  std::vector<std::string> libraries() const;
  // A T* as void*; throws CreateClassException or LibraryLoadException.
  void* create(const std::string& lookup_name, const char* base, bool auto_load);

 private:
  std::string package_, base_class_, attribute_;
  std::vector<std::string> given_paths_, xml_paths_;
  std::map<std::string, ClassDesc> classes_;
  std::map<std::string, int> loaded_;  // by lookup name: how often
};

std::string name_without_package(const std::string& lookup_name);

}  // namespace detail

// Makes objects of classes that packages have declared in their plug-in descriptions.
template <class T>
class ClassLoader : public ClassLoaderBase {
 public:
  ClassLoader(std::string package, std::string base_class,
              std::string attrib_name = std::string("plugin"),
              std::vector<std::string> plugin_xml_paths = std::vector<std::string>())
      : finder_(package, base_class, attrib_name, plugin_xml_paths) {}
  ~ClassLoader() override = default;

  gazelle::PluginPointer<T> createInstance(const std::string& lookup_name) {
    return gazelle::PluginPointer<T>(make(lookup_name, true));
  }
  std::shared_ptr<T> createSharedInstance(const std::string& lookup_name) {
    return std::shared_ptr<T>(make(lookup_name, true));
  }
  UniquePtr<T> createUniqueInstance(const std::string& lookup_name) {
    return UniquePtr<T>(make(lookup_name, true), [](T* object) { delete object; });
  }
  T* createUnmanagedInstance(const std::string& lookup_name) { return make(lookup_name, true); }
  // pluginlib's name of long ago.
  T* createClassInstance(const std::string& lookup_name, bool auto_load = true) {
    return make(lookup_name, auto_load);
  }

  std::vector<std::string> getPluginXmlPaths() override { return finder_.xml_paths(); }
  std::vector<std::string> getDeclaredClasses() override {
    std::vector<std::string> names;
    for (const auto& entry : finder_.classes()) names.push_back(entry.first);
    return names;
  }
  std::string getName(const std::string& lookup_name) override {
    return detail::name_without_package(lookup_name);
  }
  std::string getBaseClassType() const { return finder_.base_class(); }
  std::string getClassType(const std::string& lookup_name) override {
    return text(lookup_name, &ClassDesc::derived_class_);
  }
  std::string getClassDescription(const std::string& lookup_name) override {
    return text(lookup_name, &ClassDesc::description_);
  }
  std::string getClassPackage(const std::string& lookup_name) override {
    return text(lookup_name, &ClassDesc::package_);
  }
  std::string getPluginManifestPath(const std::string& lookup_name) override {
    return text(lookup_name, &ClassDesc::plugin_manifest_path_);
  }
  std::string getClassLibraryPath(const std::string& lookup_name) {
    return isClassAvailable(lookup_name) ? finder_.library_path(lookup_name) : std::string();
  }
  std::vector<std::string> getRegisteredLibraries() { return finder_.libraries(); }
  bool isClassAvailable(const std::string& lookup_name) override {
    return finder_.classes().count(lookup_name) != 0;
  }
  bool isClassLoaded(const std::string& lookup_name) override {
    return finder_.is_loaded(lookup_name);
  }
  void loadLibraryForClass(const std::string& lookup_name) override { finder_.load(lookup_name); }
  int unloadLibraryForClass(const std::string& lookup_name) override {
    return finder_.unload(lookup_name);
  }
  void refreshDeclaredClasses() { finder_.refresh(); }

 private:
  T* make(const std::string& lookup_name, bool auto_load) {
    return static_cast<T*>(finder_.create(lookup_name, typeid(T).name(), auto_load));
  }
  std::string text(const std::string& lookup_name, std::string ClassDesc::*member) const {
    const auto found = finder_.classes().find(lookup_name);
    return found == finder_.classes().end() ? std::string() : found->second.*member;
  }

  detail::PluginFinder finder_;
};

}  // namespace pluginlib
