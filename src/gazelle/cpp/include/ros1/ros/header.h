#pragma once
#include <std_msgs/Header.h>
