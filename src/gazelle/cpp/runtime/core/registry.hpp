// Objects by number: the host calls back with numbers, of which the object may be gone already.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <unordered_map>
#include <vector>

namespace gazelle {

template <class T>
class Registry {
 public:
  std::uint64_t add(std::weak_ptr<T> object) {
    std::unique_lock lock(mutex_);
    objects_.emplace(++last_, std::move(object));
    return last_;
  }

  void remove(std::uint64_t number) {
    std::unique_lock lock(mutex_);
    objects_.erase(number);
  }

  std::shared_ptr<T> find(std::uint64_t number) const {
    std::shared_lock lock(mutex_);
    auto found = objects_.find(number);
    return found == objects_.end() ? nullptr : found->second.lock();
  }

  std::vector<std::shared_ptr<T>> all() const {
    std::vector<std::shared_ptr<T>> found;
    std::shared_lock lock(mutex_);
    for (const auto& one : objects_) {
      if (auto object = one.second.lock()) found.push_back(std::move(object));
    }
    return found;
  }

 private:
  mutable std::shared_mutex mutex_;
  std::unordered_map<std::uint64_t, std::weak_ptr<T>> objects_;
  std::uint64_t last_ = 0;
};

}  // namespace gazelle
