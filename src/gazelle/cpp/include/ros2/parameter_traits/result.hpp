#pragma once

#include <parameter_traits/parameter_traits.hpp>
