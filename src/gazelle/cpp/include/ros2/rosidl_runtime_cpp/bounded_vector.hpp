#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rosidl_runtime_cpp {

// A vector that refuses to hold more than `UpperBound` elements.
template <typename Tp, std::size_t UpperBound, typename Alloc = std::allocator<Tp>>
class BoundedVector : protected std::vector<Tp, Alloc> {
  using Base = std::vector<Tp, Alloc>;

 public:
  using typename Base::allocator_type;
  using typename Base::const_iterator;
  using typename Base::const_pointer;
  using typename Base::const_reference;
  using typename Base::const_reverse_iterator;
  using typename Base::difference_type;
  using typename Base::iterator;
  using typename Base::pointer;
  using typename Base::reference;
  using typename Base::reverse_iterator;
  using typename Base::size_type;
  using typename Base::value_type;

  BoundedVector() = default;
  explicit BoundedVector(const allocator_type& a) : Base(a) {}
  explicit BoundedVector(size_type n, const allocator_type& a = allocator_type())
      : Base(checked(n), a) {}
  BoundedVector(size_type n, const value_type& value, const allocator_type& a = allocator_type())
      : Base(checked(n), value, a) {}
  BoundedVector(std::initializer_list<value_type> values,
                const allocator_type& a = allocator_type())
      : Base((checked(values.size()), values), a) {}
  template <typename Input, typename = typename std::iterator_traits<Input>::iterator_category>
  BoundedVector(Input first, Input last, const allocator_type& a = allocator_type())
      : Base(first, last, a) {
    checked(Base::size());
  }
  BoundedVector& operator=(std::initializer_list<value_type> values) {
    checked(values.size());
    Base::operator=(values);
    return *this;
  }

  void assign(size_type n, const value_type& value) { Base::assign(checked(n), value); }
  template <typename Input, typename = typename std::iterator_traits<Input>::iterator_category>
  void assign(Input first, Input last) {
    Base values(first, last);
    checked(values.size());
    Base::swap(values);
  }
  void assign(std::initializer_list<value_type> values) { *this = values; }

  using Base::at;
  using Base::back;
  using Base::begin;
  using Base::capacity;
  using Base::cbegin;
  using Base::cend;
  using Base::clear;
  using Base::crbegin;
  using Base::crend;
  using Base::data;
  using Base::empty;
  using Base::end;
  using Base::erase;
  using Base::front;
  using Base::get_allocator;
  using Base::operator[];
  using Base::pop_back;
  using Base::rbegin;
  using Base::rend;
  using Base::shrink_to_fit;
  using Base::size;

  size_type max_size() const noexcept { return std::min(UpperBound, Base::max_size()); }
  void reserve(size_type n) { Base::reserve(checked(n)); }
  void resize(size_type n) { Base::resize(checked(n)); }
  void resize(size_type n, const value_type& value) { Base::resize(checked(n), value); }
  void push_back(const value_type& value) {
    checked(Base::size() + 1);
    Base::push_back(value);
  }
  void push_back(value_type&& value) {
    checked(Base::size() + 1);
    Base::push_back(std::move(value));
  }
  template <typename... Arguments>
  decltype(auto) emplace_back(Arguments&&... arguments) {
    checked(Base::size() + 1);
    return Base::emplace_back(std::forward<Arguments>(arguments)...);
  }
  template <typename... Arguments>
  iterator emplace(const_iterator where, Arguments&&... arguments) {
    checked(Base::size() + 1);
    return Base::emplace(where, std::forward<Arguments>(arguments)...);
  }
  iterator insert(const_iterator where, const value_type& value) {
    checked(Base::size() + 1);
    return Base::insert(where, value);
  }
  iterator insert(const_iterator where, value_type&& value) {
    checked(Base::size() + 1);
    return Base::insert(where, std::move(value));
  }
  iterator insert(const_iterator where, size_type n, const value_type& value) {
    checked(Base::size() + n);
    return Base::insert(where, n, value);
  }
  iterator insert(const_iterator where, std::initializer_list<value_type> values) {
    checked(Base::size() + values.size());
    return Base::insert(where, values);
  }
  template <typename Input, typename = typename std::iterator_traits<Input>::iterator_category>
  iterator insert(const_iterator where, Input first, Input last) {
    checked(Base::size() + static_cast<size_type>(std::distance(first, last)));
    return Base::insert(where, first, last);
  }
  void swap(BoundedVector& other) noexcept { Base::swap(other); }

  friend bool operator==(const BoundedVector& l, const BoundedVector& r) {
    return static_cast<const Base&>(l) == static_cast<const Base&>(r);
  }
  friend bool operator!=(const BoundedVector& l, const BoundedVector& r) { return !(l == r); }
  friend bool operator<(const BoundedVector& l, const BoundedVector& r) {
    return static_cast<const Base&>(l) < static_cast<const Base&>(r);
  }
  friend bool operator>(const BoundedVector& l, const BoundedVector& r) { return r < l; }
  friend bool operator<=(const BoundedVector& l, const BoundedVector& r) { return !(r < l); }
  friend bool operator>=(const BoundedVector& l, const BoundedVector& r) { return !(l < r); }
  friend void swap(BoundedVector& l, BoundedVector& r) noexcept { l.swap(r); }

 private:
  static size_type checked(size_type n) {
    if (n > UpperBound) {
      throw std::length_error("Exceeded upper bound");
    }
    return n;
  }
};

}  // namespace rosidl_runtime_cpp
