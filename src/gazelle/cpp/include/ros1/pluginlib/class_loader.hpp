#pragma once

// As the original does it: programs use what comes with these.
#include <ros/console.h>
#include <ros/package.h>

#include "gazelle/plugins/plugin_loader.hpp"
