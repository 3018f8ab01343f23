#pragma once

#include "gazelle/plugins/plugin_loader.hpp"
