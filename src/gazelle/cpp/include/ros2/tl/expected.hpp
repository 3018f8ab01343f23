#pragma once

#include <tl_expected/expected.hpp>
