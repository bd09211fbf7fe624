// The namespace of each module, and the modules whose names it sees without qualification (docs/architecture.md). The
// names of `core` stand in `lampblack` itself and are shared by all modules. Two modules may use one name for different
// things.
#pragma once

namespace lampblack {

namespace chemistry {}
namespace io {}

namespace particles {
using namespace chemistry;
}

namespace flow {
using namespace chemistry;
}

namespace coupling {
using namespace chemistry;
using namespace flow;
using namespace particles;
}  // namespace coupling

namespace app {
using namespace chemistry;
using namespace coupling;
using namespace flow;
using namespace io;
using namespace particles;
}  // namespace app

}  // namespace lampblack
