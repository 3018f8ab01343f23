// boost::shared_ptr and std::shared_ptr of the same object: either keeps the other's count.
#pragma once

#include <boost/shared_ptr.hpp>
#include <memory>
#include <utility>

namespace gazelle {

namespace detail {

// Deleters that hold the other kind of pointer: the object goes when both have let go. They are
// found again by get_deleter, so there and back shares the first count and makes no chain.
struct HoldsStd {
  std::shared_ptr<const void> held;
  void operator()(const void*) { held.reset(); }
};

struct HoldsBoost {
  boost::shared_ptr<const void> held;
  void operator()(const void*) { held.reset(); }
};

}  // namespace detail

template <class T>
boost::shared_ptr<T> to_boost(const std::shared_ptr<T>& pointer) {
  if (!pointer) return {};
  if (auto* deleter = std::get_deleter<detail::HoldsBoost>(pointer)) {
    return boost::shared_ptr<T>(deleter->held, pointer.get());
  }
  return boost::shared_ptr<T>(pointer.get(), detail::HoldsStd{pointer});
}

template <class T>
std::shared_ptr<T> to_std(const boost::shared_ptr<T>& pointer) {
  if (!pointer) return {};
  if (auto* deleter = boost::get_deleter<detail::HoldsStd>(pointer)) {
    return std::shared_ptr<T>(deleter->held, pointer.get());
  }
  return std::shared_ptr<T>(pointer.get(), detail::HoldsBoost{pointer});
}

// For templates that do not know which kind they have.
template <class T>
std::shared_ptr<T> to_std(std::shared_ptr<T> pointer) {
  return pointer;
}

template <class T>
boost::shared_ptr<T> to_boost(boost::shared_ptr<T> pointer) {
  return pointer;
}

}  // namespace gazelle
