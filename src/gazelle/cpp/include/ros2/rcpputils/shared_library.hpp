#pragma once

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace rcpputils {

/// A library that is loaded while the object lives; the graph never closes it.
class SharedLibrary {
 public:
  explicit SharedLibrary(const std::string& path)
      : path_(path), library_(dlopen(path.c_str(), RTLD_LAZY)) {
    if (!library_) throw std::runtime_error(std::string("dlopen error: ") + dlerror());
  }
  virtual ~SharedLibrary() = default;
  SharedLibrary(const SharedLibrary&) = delete;
  SharedLibrary& operator=(const SharedLibrary&) = delete;

  void unload_library() { library_ = nullptr; }
  bool has_symbol(const char* name) { return library_ && dlsym(library_, name); }
  bool has_symbol(const std::string& name) { return has_symbol(name.c_str()); }
  void* get_symbol(const char* name) {
    if (!library_) throw std::runtime_error("Invalid library, it is not loaded");
    void* found = dlsym(library_, name);
    if (!found) throw std::runtime_error(std::string("dlsym error: ") + dlerror());
    return found;
  }
  void* get_symbol(const std::string& name) { return get_symbol(name.c_str()); }
  std::string get_library_path() { return path_; }

 private:
  std::string path_;
  void* library_;
};

inline std::string get_platform_library_name(std::string name, bool debug = false) {
  return "lib" + name + (debug ? "d" : "") + ".so";
}

}  // namespace rcpputils
