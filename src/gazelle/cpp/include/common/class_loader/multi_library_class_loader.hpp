#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "class_loader/class_loader.hpp"

namespace class_loader {

// A class loader over several libraries.
class MultiLibraryClassLoader {
 public:
  explicit MultiLibraryClassLoader(bool enable_ondemand_loadunload)
      : on_demand_(enable_ondemand_loadunload) {}
  virtual ~MultiLibraryClassLoader() = default;

  template <class Base>
  gazelle::PluginPointer<Base> createInstance(const std::string& class_name) {
    return owner<Base>(class_name).template createInstance<Base>(class_name);
  }
  template <class Base>
  gazelle::PluginPointer<Base> createInstance(const std::string& class_name,
                                              const std::string& library_path) {
    return of(library_path).template createInstance<Base>(class_name);
  }
  template <class Base>
  std::shared_ptr<Base> createSharedInstance(const std::string& class_name) {
    return owner<Base>(class_name).template createSharedInstance<Base>(class_name);
  }
  template <class Base>
  ClassLoader::UniquePtr<Base> createUniqueInstance(const std::string& class_name) {
    return owner<Base>(class_name).template createUniqueInstance<Base>(class_name);
  }
  template <class Base>
  ClassLoader::UniquePtr<Base> createUniqueInstance(const std::string& class_name,
                                                    const std::string& library_path) {
    return of(library_path).template createUniqueInstance<Base>(class_name);
  }
  template <class Base>
  Base* createUnmanagedInstance(const std::string& class_name) {
    return owner<Base>(class_name).template createUnmanagedInstance<Base>(class_name);
  }
  template <class Base>
  Base* createUnmanagedInstance(const std::string& class_name, const std::string& library_path) {
    return of(library_path).template createUnmanagedInstance<Base>(class_name);
  }

  template <class Base>
  bool isClassAvailable(const std::string& class_name) const {
    for (const auto& entry : loaders_) {
      if (entry.second->template isClassAvailable<Base>(class_name)) return true;
    }
    return false;
  }
  template <class Base>
  std::vector<std::string> getAvailableClasses() const {
    std::vector<std::string> found;
    for (const auto& entry : loaders_) {
      const auto names = entry.second->template getAvailableClasses<Base>();
      found.insert(found.end(), names.begin(), names.end());
    }
    return found;
  }
  template <class Base>
  std::vector<std::string> getAvailableClassesForLibrary(const std::string& library_path) {
    return of(library_path).template getAvailableClasses<Base>();
  }

  bool isLibraryAvailable(const std::string& library_path) const {
    return loaders_.count(library_path) != 0;
  }
  std::vector<std::string> getRegisteredLibraries() const {
    std::vector<std::string> found;
    for (const auto& entry : loaders_) found.push_back(entry.first);
    return found;
  }
  void loadLibrary(const std::string& library_path) {
    if (!isLibraryAvailable(library_path)) {
      loaders_[library_path] = std::make_shared<ClassLoader>(library_path, on_demand_);
    }
  }
  int unloadLibrary(const std::string& library_path) {
    const auto found = loaders_.find(library_path);
    if (found == loaders_.end()) return 0;
    const int left = found->second->unloadLibrary();
    if (left == 0) loaders_.erase(found);
    return left;
  }

 private:
  ClassLoader& of(const std::string& library_path) {
    const auto found = loaders_.find(library_path);
    if (found == loaders_.end()) {
      throw NoClassLoaderExistsException("No class loader for library '" + library_path +
                                         "': loadLibrary() was not called for it");
    }
    return *found->second;
  }
  template <class Base>
  ClassLoader& owner(const std::string& class_name) {
    for (const auto& entry : loaders_) {
      if (!entry.second->isLibraryLoaded()) entry.second->loadLibrary();
      if (entry.second->template isClassAvailable<Base>(class_name)) return *entry.second;
    }
    throw CreateClassException("Could not create object of class type " + class_name +
                               ": none of the loaded libraries has registered it");
  }

  bool on_demand_;
  std::map<std::string, std::shared_ptr<ClassLoader>> loaders_;
};

}  // namespace class_loader
