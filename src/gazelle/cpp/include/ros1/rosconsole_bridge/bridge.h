#pragma once
// console_bridge's messages are told as rosconsole's already.

namespace rosconsole_bridge {
struct RegisterOutputHandlerProxy {};
}  // namespace rosconsole_bridge

#define REGISTER_ROSCONSOLE_BRIDGE \
  static rosconsole_bridge::RegisterOutputHandlerProxy __attribute__((unused)) \
  rosconsole_bridge_proxy
