#pragma once

#include <memory>
#include <stdexcept>
#include <type_traits>

namespace rclcpp {
namespace allocator {

/// Gives an object back to the allocator that it is from.
template <typename Allocator>
class AllocatorDeleter {
  template <typename T>
  using Rebound = typename std::allocator_traits<Allocator>::template rebind_alloc<T>;

 public:
  AllocatorDeleter() = default;
  explicit AllocatorDeleter(Allocator* allocator) : allocator_(allocator) {}
  template <typename T>
  explicit AllocatorDeleter(const AllocatorDeleter<T>& other) : allocator_(other.get_allocator()) {}

  template <typename T>
  void operator()(T* pointer) {
    std::allocator_traits<Rebound<T>>::destroy(*allocator_, pointer);
    std::allocator_traits<Rebound<T>>::deallocate(*allocator_, pointer, 1);
  }
  Allocator* get_allocator() const { return allocator_; }
  void set_allocator(Allocator* allocator) { allocator_ = allocator; }

 private:
  Allocator* allocator_ = nullptr;
};

template <typename Alloc, typename T, typename D>
void set_allocator_for_deleter(D* deleter, Alloc* allocator) {
  (void)allocator;
  (void)deleter;
  throw std::runtime_error("Reached unexpected template specialization");
}
template <typename T, typename U>
void set_allocator_for_deleter(std::default_delete<T>* deleter, std::allocator<U>* allocator) {
  (void)deleter;
  (void)allocator;
}
template <typename Alloc, typename T>
void set_allocator_for_deleter(AllocatorDeleter<T>* deleter, Alloc* allocator) {
  if (!deleter || !allocator) {
    throw std::invalid_argument("Argument was NULL to set_allocator_for_deleter");
  }
  deleter->set_allocator(allocator);
}

template <typename Alloc, typename T>
using Deleter = typename std::conditional<
    std::is_same<typename std::allocator_traits<Alloc>::template rebind_alloc<T>,
                 std::allocator<T>>::value,
    std::default_delete<T>, AllocatorDeleter<Alloc>>::type;

}  // namespace allocator
}  // namespace rclcpp
