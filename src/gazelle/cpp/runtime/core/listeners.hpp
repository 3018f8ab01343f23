// Functions by number, called in the order in which they were added.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace gazelle {

template <class... Arguments>
class Listeners {
 public:
  using Function = std::function<void(Arguments...)>;

  std::uint64_t add(Function function) {
    std::lock_guard lock(mutex_);
    functions_.emplace(++last_, std::move(function));
    return last_;
  }

  bool remove(std::uint64_t number) {
    std::lock_guard lock(mutex_);
    return functions_.erase(number) != 0;
  }

  void tell(Arguments... arguments) const {
    for (const auto& one : copies()) one(arguments...);
  }

  bool empty() const {
    std::lock_guard lock(mutex_);
    return functions_.empty();
  }

  // Outside of the lock: a function may add and remove others.
  std::vector<Function> copies() const {
    std::lock_guard lock(mutex_);
    std::vector<Function> found;
    found.reserve(functions_.size());
    for (const auto& one : functions_) found.push_back(one.second);
    return found;
  }

  std::vector<Function> take() {
    std::lock_guard lock(mutex_);
    std::vector<Function> found;
    for (auto& one : functions_) found.push_back(std::move(one.second));
    functions_.clear();
    return found;
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::uint64_t, Function> functions_;
  std::uint64_t last_ = 0;
};

}  // namespace gazelle
