#pragma once

#include <memory>
#include <utility>

namespace rclcpp {
namespace detail {

/// Deletes a message that was given away by a `unique_ptr`, unless its last reader takes it back.
template <class M, class D>
struct GiveBack {
  D deleter;
  bool taken = false;
  void operator()(const void* message) {
    if (!taken) deleter(static_cast<M*>(const_cast<void*>(message)));
  }
};

template <class M, class D>
std::shared_ptr<const void> shared_of(std::unique_ptr<M, D> message) {
  D deleter = std::move(message.get_deleter());
  const void* raw = message.release();
  return std::shared_ptr<const void>(raw, GiveBack<M, D>{std::move(deleter), false});
}

/// Take a message out of its shared pointer where nobody else holds it, else copy it.
template <class M>
std::unique_ptr<M> unique_of(std::shared_ptr<const void> message) {
  if (message.use_count() == 1) {
    if (auto* held = std::get_deleter<GiveBack<M, std::default_delete<M>>>(message)) {
      held->taken = true;
      return std::unique_ptr<M>(static_cast<M*>(const_cast<void*>(message.get())));
    }
  }
  return std::make_unique<M>(*static_cast<const M*>(message.get()));
}

}  // namespace detail
}  // namespace rclcpp
