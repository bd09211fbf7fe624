// How long the program has been running, for limits of wall time.
#pragma once

namespace lampblack {

// s, since this process was started, MPI's own start included.
double secondsSinceStart();

}  // namespace lampblack
