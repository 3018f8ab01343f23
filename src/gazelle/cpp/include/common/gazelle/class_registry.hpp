#pragma once

#include <mutex>
#include <string>
#include <typeinfo>
#include <vector>

namespace gazelle {

// One class that can be made by its name: what CLASS_LOADER_REGISTER_CLASS leaves behind.
struct ClassRecord {
  std::string name;       // as written in the macro, such as "my_pkg::MyClass"
  std::string base;       // typeid(Base).name()
  std::string base_name;  // as written in the macro
  void* (*create)();      // a Base*, as void*
  std::string library;    // the file that holds it; filled in by add()
};

// All classes of the process. The one instance lives in the runtime library.
class ClassRegistry {
 public:
  static ClassRegistry& instance();

  // Takes a class; the library is the file that `create` lies in.
  void add(ClassRecord record);

  // Tells whether a base has a class of this name, and makes one of it (null: there is none).
  bool has(const std::string& name, const std::string& base, const std::string& library = "") const;
  void* create(const std::string& name, const std::string& base,
               const std::string& library = "") const;

  // Names of the classes of a base, in the order of their registration.
  std::vector<std::string> names(const std::string& base, const std::string& library = "") const;

  // Whatever is registered, in the order of registration.
  std::vector<ClassRecord> records() const;

 private:
  mutable std::mutex mutex_;
  std::vector<ClassRecord> records_;
};

// Loads a shared library for good: it stays until the process ends. Returns its handle.
// Throws std::runtime_error with the loader's words.
void* load_library(const std::string& path);

// The absolute path, links resolved, by which records name a library; the path itself where there
// is no such file.
std::string library_identity(const std::string& path);

namespace detail {
template <class Derived, class Base>
struct ClassRegistrar {
  ClassRegistrar(const char* name, const char* base_name) {
    ClassRegistry::instance().add(
        {name, typeid(Base).name(), base_name, &ClassRegistrar::create, std::string()});
  }
  static void* create() { return static_cast<Base*>(new Derived); }
};
}  // namespace detail
}  // namespace gazelle
