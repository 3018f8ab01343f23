#include "class_loader/class_loader.hpp"

#include <atomic>

namespace class_loader {
namespace {
std::atomic<bool> g_unmanaged{false};
}  // namespace

std::string systemLibraryFormat(const std::string& library_name) {
  return "lib" + library_name + ".so";
}

ClassLoader::ClassLoader(const std::string& library_path, bool ondemand_load_unload)
    : path_(library_path),
      identity_(gazelle::library_identity(library_path)),
      on_demand_(ondemand_load_unload) {
  if (!on_demand_) loadLibrary();
}

ClassLoader::~ClassLoader() = default;

bool ClassLoader::hasUnmanagedInstanceBeenCreated() { return g_unmanaged; }

void ClassLoader::loadLibrary() {
  try {
    gazelle::load_library(path_);
  } catch (const std::runtime_error& error) {
    throw LibraryLoadException("Could not load library " + path_ + ": " + error.what());
  }
  loaded_ = true;
  ++count_;
}

int ClassLoader::unloadLibrary() {
  if (count_ > 0) --count_;
  return count_;
}

void* ClassLoader::create(const std::string& class_name, const char* base) {
  if (!isLibraryLoaded()) loadLibrary();
  void* made = gazelle::ClassRegistry::instance().create(class_name, base, identity_);
  if (made != nullptr) {
    g_unmanaged = true;
    return made;
  }
  std::string known;
  for (const auto& name : gazelle::ClassRegistry::instance().names(base, identity_)) {
    known += (known.empty() ? "" : ", ") + name;
  }
  throw CreateClassException("Could not create instance of type " + class_name + ": library " +
                             path_ + " has registered " +
                             (known.empty() ? "no class of this base" : known));
}

}  // namespace class_loader
