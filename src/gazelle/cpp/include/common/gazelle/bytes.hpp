// Bytes that somebody owns; cheap to copy, never changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace gazelle {

class Bytes {
 public:
  Bytes() = default;
  // Borrow: `owner` keeps the memory for as long as any copy lives.
  Bytes(const std::uint8_t* data, std::size_t size, std::shared_ptr<const void> owner)
      : data_(data), size_(size), owner_(std::move(owner)) {}
  // Take over.
  Bytes(std::vector<std::uint8_t> bytes) {  // NOLINT: a value
    auto kept = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
    data_ = kept->data();
    size_ = kept->size();
    owner_ = std::move(kept);
  }

  const std::uint8_t* data() const { return data_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const std::uint8_t* begin() const { return data_; }
  const std::uint8_t* end() const { return data_ + size_; }
  std::vector<std::uint8_t> to_vector() const { return {begin(), end()}; }

 private:
  const std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0;
  std::shared_ptr<const void> owner_;
};

}  // namespace gazelle
