// The namespace of each module, and the modules whose names it sees without qualification (docs/architecture.md). The
// names of `core` stand in `lampblack` itself and are shared by all modules. Two modules may use one name for different
// things.
#pragma once

namespace lampblack {

namespace io {}
namespace numerics {}

namespace chemistry {
using namespace numerics;
}

namespace particles {
using namespace chemistry;
using namespace numerics;
}  // namespace particles

namespace flow {
using namespace chemistry;
using namespace numerics;
}  // namespace flow

namespace coupling {
using namespace chemistry;
using namespace flow;
using namespace numerics;
using namespace particles;
}  // namespace coupling

namespace app {
using namespace chemistry;
using namespace coupling;
using namespace flow;
using namespace io;
using namespace numerics;
using namespace particles;
}  // namespace app

}  // namespace lampblack
