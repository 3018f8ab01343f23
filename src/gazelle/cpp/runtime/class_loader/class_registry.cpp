#include "gazelle/class_registry.hpp"

#include <dlfcn.h>
#include <stdlib.h>

#include <map>
#include <memory>
#include <stdexcept>

namespace gazelle {
namespace {

std::string library_of(void* address) {
  Dl_info info;
  if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) return std::string();
  return library_identity(info.dli_fname);
}

bool fits(const ClassRecord& record, const std::string& base, const std::string& library) {
  return record.base == base && (library.empty() || record.library == library);
}

}  // namespace

std::string library_identity(const std::string& path) {
  const std::unique_ptr<char, void (*)(void*)> real(realpath(path.c_str(), nullptr), &free);
  return real ? std::string(real.get()) : path;
}

void* load_library(const std::string& path) {
  static std::mutex mutex;
  static auto& handles = *new std::map<std::string, void*>;
  const std::string identity = library_identity(path);
  {
    const std::lock_guard<std::mutex> lock(mutex);
    const auto found = handles.find(identity);
    if (found != handles.end()) return found->second;
  }
  // Static initialisers may load further libraries, so no lock is held here.
  void* handle = dlopen(identity.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* words = dlerror();
    throw std::runtime_error(words == nullptr ? "cannot load " + path : words);
  }
  const std::lock_guard<std::mutex> lock(mutex);
  handles[identity] = handle;
  return handle;
}

// Never destroyed: libraries register and ask until the very end of the process.
ClassRegistry& ClassRegistry::instance() {
  static auto& registry = *new ClassRegistry;
  return registry;
}

void ClassRegistry::add(ClassRecord record) {
  record.library = library_of(reinterpret_cast<void*>(record.create));
  const std::lock_guard<std::mutex> lock(mutex_);
  records_.push_back(std::move(record));
}

bool ClassRegistry::has(const std::string& name, const std::string& base,
                        const std::string& library) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& record : records_) {
    if (record.name == name && fits(record, base, library)) return true;
  }
  return false;
}

void* ClassRegistry::create(const std::string& name, const std::string& base,
                            const std::string& library) const {
  void* (*make)() = nullptr;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    // The last one: a library compiled anew is loaded beside its older self.
    for (const auto& record : records_) {
      if (record.name == name && fits(record, base, library)) make = record.create;
    }
  }
  return make == nullptr ? nullptr : make();
}

std::vector<std::string> ClassRegistry::names(const std::string& base,
                                              const std::string& library) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> found;
  for (const auto& record : records_) {
    if (fits(record, base, library)) found.push_back(record.name);
  }
  return found;
}

std::vector<ClassRecord> ClassRegistry::records() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return records_;
}

}  // namespace gazelle
