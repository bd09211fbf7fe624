#include "core/vector3.hpp"

#include <fmt/format.h>

namespace lampblack {

std::string placeText(const Vector3& place, int dimension) {
  return dimension == 2 ? fmt::format("({:.6g}, {:.6g}) m", place[0], place[1])
                        : fmt::format("({:.6g}, {:.6g}, {:.6g}) m", place[0], place[1], place[2]);
}

}  // namespace lampblack
