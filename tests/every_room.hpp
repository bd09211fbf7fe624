// The helpers of tests see all rooms.
#pragma once

#include "core/rooms.hpp"
#include "tests/every_room.hpp"

namespace lampblack::test {
using namespace app;
}

namespace lampblack::bench {
using namespace app;
}
