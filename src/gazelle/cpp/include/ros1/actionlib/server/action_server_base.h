#pragma once
#include <actionlib/server/action_server.h>
