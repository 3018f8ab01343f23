#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "rcpputils/split.hpp"

namespace rcpputils {
namespace fs {

/// A path under rcpputils' names; `std::filesystem` does the work.
class path {
 public:
  static constexpr const char preferred_separator = '/';
  path() = default;
  path(const std::string& text) : path_(text) {}  // NOLINT(runtime/explicit)
  path(const char* text) : path_(text) {}         // NOLINT(runtime/explicit)
  explicit path(std::filesystem::path given) : path_(std::move(given)) {}

  std::string string() const { return path_.string(); }
  bool exists() const { return std::filesystem::exists(path_, ignored()); }
  bool is_directory() const noexcept { return std::filesystem::is_directory(path_, ignored()); }
  bool is_regular_file() const noexcept {
    return std::filesystem::is_regular_file(path_, ignored());
  }
  std::uint64_t file_size() const { return std::filesystem::file_size(path_); }
  bool empty() const { return path_.empty(); }
  bool is_absolute() const { return path_.is_absolute(); }
  path parent_path() const { return path(path_.parent_path()); }
  path filename() const { return path(path_.filename()); }
  path extension() const { return path(path_.extension()); }
  path& replace_extension(const path& extension = path()) {
    path_.replace_extension(extension.path_);
    return *this;
  }
  path operator/(const std::string& part) const { return path(path_ / part); }
  path operator/(const path& part) const { return path(path_ / part.path_); }
  path& operator/=(const path& part) {
    path_ /= part.path_;
    return *this;
  }
  path& operator/=(const std::string& part) {
    path_ /= part;
    return *this;
  }
  bool operator==(const path& other) const { return path_ == other.path_; }
  bool operator!=(const path& other) const { return path_ != other.path_; }
  std::vector<std::string>::const_iterator cbegin() const { return parts().cbegin(); }
  std::vector<std::string>::const_iterator cend() const { return parts_.cend(); }

 private:
  static std::error_code& ignored() {
    thread_local std::error_code code;
    return code;
  }
  const std::vector<std::string>& parts() const {
    parts_ = rcpputils::split(path_.string(), '/');
    return parts_;
  }
  std::filesystem::path path_;
  mutable std::vector<std::string> parts_;
};

inline bool is_regular_file(const path& p) noexcept { return p.is_regular_file(); }
inline bool is_directory(const path& p) noexcept { return p.is_directory(); }
inline std::uint64_t file_size(const path& p) { return p.file_size(); }
inline bool exists(const path& p) { return p.exists(); }
inline path temp_directory_path() { return path(std::filesystem::temp_directory_path().string()); }
inline path current_path() { return path(std::filesystem::current_path().string()); }
inline bool create_directories(const path& p) {
  std::error_code error;
  std::filesystem::create_directories(p.string(), error);
  return !error;
}
inline bool create_directory(const path& p) { return create_directories(p); }
inline bool remove(const path& p) {
  std::error_code error;
  return std::filesystem::remove(p.string(), error);
}
inline bool remove_all(const path& p) {
  std::error_code error;
  std::filesystem::remove_all(p.string(), error);
  return !error;
}
inline path remove_extension(const path& p, int times = 1) {
  std::filesystem::path shorter = p.string();
  for (; times > 0; --times) shorter.replace_extension();
  return path(shorter.string());
}
inline bool operator<(const path& a, const path& b) { return a.string() < b.string(); }

}  // namespace fs
}  // namespace rcpputils
