// Orders of accuracy on cells without order: triangles, both, tetrahedra, prisms, hexahedra and pyramids whose vertices
// are moved by a fifth of a cell.
#include "flow_exact.hpp"
#include "graded_stream.hpp"

namespace lampblack::test {
namespace {

using FlowSkewed = FlowExact;

TEST_F(FlowSkewed, Kovasznay) {
  for (const Cells cells : {Cells::Quadrilaterals, Cells::Triangles, Cells::MixedPlane})
    expectKovasznay(fmt::format("Kovasznay on skewed cells {}", static_cast<int>(cells)),
                    [](int n) {
                      return Axes{uniformAxis(1.5, 3 * n / 2), uniformAxis(0.5, n / 2)};
                    },
                    120, {1.8, 1.8, 1.0, 1.0}, Split{cells});
}

class SkewedStream : public GradedStream {};

TEST_F(SkewedStream, DiffusionAgainstConvection) {
  for (const Cells cells : {Cells::Quadrilaterals, Cells::Triangles, Cells::MixedPlane})
    for (const bool ofComposition : {false, true}) {
      std::array<double, 3> largest{}, mean{};
      for (std::size_t level = 0; level < 3; ++level) {
        const int n = 8 << level;
        largest[level] = error({Geometry::Planar, ofComposition}, {uniformAxis(0.01, n), uniformAxis(5e-3, n / 2)},
                               Split{cells}, &mean[level]);
      }
      const std::string what = fmt::format("{} against convection on skewed cells {}, 8, 16, 32",
                                           ofComposition ? "diffusion" : "conduction", static_cast<int>(cells));
      expectOrders(what + ", mean", mean, 1.8);
      expectOrders(what + ", largest", largest, 1.0);
    }
}

}  // namespace
}  // namespace lampblack::test
