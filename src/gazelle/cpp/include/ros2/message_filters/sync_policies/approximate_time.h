#pragma once
#include <gazelle/message_filters/synchronizing.hpp>
