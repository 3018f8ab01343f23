#pragma once
#include <ros/console_sites.h>
