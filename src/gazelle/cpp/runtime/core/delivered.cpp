// A message on its way: the publisher's object, bytes, or both, made from each other once.
#include <map>
#include <mutex>
#include <utility>

#include "gazelle/core.hpp"

namespace gazelle {

// What all copies of one delivery share.
struct Delivered::Shared {
  std::mutex mutex;
  Bytes cdr;
  bool has_cdr = false;
  // The bytes read as other types than the publisher's, by type.
  std::vector<std::pair<const MessageType*, std::shared_ptr<const void>>> read;
};

Delivered::Delivered(std::shared_ptr<const void> message, const MessageType* type, MessageInfo info)
    : info_(std::move(info)),
      type_name_(type->name),
      type_(type),
      message_(std::move(message)),
      shared_(std::make_shared<Shared>()) {}

Delivered::Delivered(Bytes cdr, std::string type_name, MessageInfo info)
    : info_(std::move(info)),
      type_name_(std::move(type_name)),
      shared_(std::make_shared<Shared>()) {
  shared_->cdr = std::move(cdr);
  shared_->has_cdr = true;
}

std::shared_ptr<const void> Delivered::object(const MessageType& wanted) const {
  if (message_ && type_->is_same(wanted)) return message_;
  const Bytes bytes = cdr();
  std::lock_guard lock(shared_->mutex);
  for (const auto& one : shared_->read) {
    if (one.first->is_same(wanted)) return one.second;
  }
  std::shared_ptr<const void> made = wanted.decode(bytes.data(), bytes.size());
  shared_->read.emplace_back(&wanted, made);
  return made;
}

std::shared_ptr<void> Delivered::own_object(const MessageType& wanted) const {
  const Bytes bytes = cdr();
  return wanted.decode(bytes.data(), bytes.size());
}

Bytes Delivered::cdr() const {
  std::lock_guard lock(shared_->mutex);
  if (!shared_->has_cdr) {
    std::vector<std::uint8_t> bytes;
    type_->encode(message_.get(), bytes);
    shared_->cdr = Bytes(std::move(bytes));
    shared_->has_cdr = true;
  }
  return shared_->cdr;
}

}  // namespace gazelle
