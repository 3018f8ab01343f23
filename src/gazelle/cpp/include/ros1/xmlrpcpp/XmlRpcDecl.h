#pragma once
#include <ros/macros.h>
