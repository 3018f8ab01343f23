#pragma once
#include <gazelle/message_filters/filters.hpp>
