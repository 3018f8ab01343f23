#pragma once

#include <functional>
#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

#include "class_loader/exceptions.hpp"
#include "class_loader/register_macro.hpp"
#include "gazelle/class_registry.hpp"
#include "gazelle/plugin_pointer.hpp"

namespace class_loader {

// "libfoo.so" of "foo", as the linker of this system names libraries.
std::string systemLibraryFormat(const std::string& library_name);

// Makes objects of the classes that one library has registered. The library, once loaded, stays:
// unloading only counts.
class ClassLoader {
 public:
  template <class Base>
  using DeleterType = std::function<void(Base*)>;
  template <class Base>
  using UniquePtr = std::unique_ptr<Base, DeleterType<Base>>;

  explicit ClassLoader(const std::string& library_path, bool ondemand_load_unload = false);
  virtual ~ClassLoader();
  ClassLoader(const ClassLoader&) = delete;
  ClassLoader& operator=(const ClassLoader&) = delete;

  template <class Base>
  std::vector<std::string> getAvailableClasses() const {
    return gazelle::ClassRegistry::instance().names(typeid(Base).name(), identity_);
  }

  template <class Base>
  bool isClassAvailable(const std::string& class_name) const {
    return gazelle::ClassRegistry::instance().has(class_name, typeid(Base).name(), identity_);
  }

  template <class Base>
  gazelle::PluginPointer<Base> createInstance(const std::string& derived_class_name) {
    return gazelle::PluginPointer<Base>(createUnmanagedInstance<Base>(derived_class_name));
  }

  template <class Base>
  std::shared_ptr<Base> createSharedInstance(const std::string& derived_class_name) {
    return std::shared_ptr<Base>(createUnmanagedInstance<Base>(derived_class_name));
  }

  template <class Base>
  UniquePtr<Base> createUniqueInstance(const std::string& derived_class_name) {
    return UniquePtr<Base>(createUnmanagedInstance<Base>(derived_class_name),
                           [](Base* object) { delete object; });
  }

  template <class Base>
  Base* createUnmanagedInstance(const std::string& derived_class_name) {
    return static_cast<Base*>(create(derived_class_name, typeid(Base).name()));
  }

  const std::string getLibraryPath() const { return path_; }
  bool isLibraryLoaded() const { return count_ > 0; }
  bool isLibraryLoadedByAnyClassloader() const { return loaded_; }
  bool isOnDemandLoadUnloadEnabled() const { return on_demand_; }
  static bool hasUnmanagedInstanceBeenCreated();

  void loadLibrary();
  int unloadLibrary();

 private:
  void* create(const std::string& class_name, const char* base);

  std::string path_;
  std::string identity_;
  bool on_demand_;
  int count_ = 0;
  bool loaded_ = false;
};

}  // namespace class_loader
