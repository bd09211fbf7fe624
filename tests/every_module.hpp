// The helpers of tests see all modules.
#pragma once

#include "core/modules.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
using namespace app;
}

namespace lampblack::bench {
using namespace app;
}
