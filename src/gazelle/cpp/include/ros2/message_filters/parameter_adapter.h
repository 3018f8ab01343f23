#pragma once
#include <message_filters/parameter_adapter.hpp>
