#pragma once

#include <cstdio>

#include "gazelle/class_registry.hpp"

#define GAZELLE_CLASS_LOADER_REGISTER_3(Derived, Base, UniqueId)                               \
  namespace {                                                                                  \
  const ::gazelle::detail::ClassRegistrar<Derived, Base> g_gazelle_class_registrar_##UniqueId( \
      #Derived, #Base);                                                                        \
  }
#define GAZELLE_CLASS_LOADER_REGISTER_2(Derived, Base, UniqueId) \
  GAZELLE_CLASS_LOADER_REGISTER_3(Derived, Base, UniqueId)

// Makes Derived known by its name to whoever looks for a Base. For the top of a .cpp file.
#define CLASS_LOADER_REGISTER_CLASS(Derived, Base) \
  GAZELLE_CLASS_LOADER_REGISTER_2(Derived, Base, __COUNTER__)

#define CLASS_LOADER_REGISTER_CLASS_WITH_MESSAGE(Derived, Base, Message)                          \
  CLASS_LOADER_REGISTER_CLASS(Derived, Base)                                                      \
  namespace {                                                                                     \
  const int GAZELLE_CLASS_LOADER_UNIQUE(g_gazelle_class_message_) = (std::fprintf(stderr, "%s\n", \
                                                                                  Message),       \
                                                                     0);                          \
  }
#define GAZELLE_CLASS_LOADER_JOIN_2(a, b) a##b
#define GAZELLE_CLASS_LOADER_JOIN(a, b) GAZELLE_CLASS_LOADER_JOIN_2(a, b)
#define GAZELLE_CLASS_LOADER_UNIQUE(prefix) GAZELLE_CLASS_LOADER_JOIN(prefix, __COUNTER__)
