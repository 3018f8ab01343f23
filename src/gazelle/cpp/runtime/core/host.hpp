// The table of the host as the core uses it.
#pragma once

#include <csignal>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "gazelle/bytes.hpp"
#include "gazelle/json.hpp"
#include "gazelle_abi.h"

namespace gazelle::host {

// The table; null before the host has attached and after it has detached.
const gazelle_host* table();

// Threads that the host starts within a call must take no signals: they are the program's.
class SignalsBlocked {
 public:
  SignalsBlocked();
  ~SignalsBlocked();
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_;
};

// Bytes that the host has lent; they are given back with the last copy. Without an owner they are
// copied at once.
Bytes lent(const std::uint8_t* data, std::size_t size, void* owner);

// Ask for the end of something: what goes wrong is said and no more, as destructors ask.
void call_at_end(const std::string& verb, const Json& request);

// Called when the graph has been left.
void on_detach(std::function<void()> listener);

}  // namespace gazelle::host
