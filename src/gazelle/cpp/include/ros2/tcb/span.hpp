#pragma once

#include <tcb_span/span.hpp>
