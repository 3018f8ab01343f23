#pragma once
#include <gazelle/message_filters/connection.hpp>
