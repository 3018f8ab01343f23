#pragma once
#include <gazelle/message_filters/calls.hpp>
