// The rooms as namespaces, and whose names each sees without saying so: the arrows of docs/architecture.md. What `core`
// owns stands in `lampblack` itself, the words that all rooms share. Two rooms may give one name to different things.
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
