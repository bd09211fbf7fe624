// Where places of a box lie before the box is bent between a floor and a ceiling, so that flows on two meshes of one
// such box can be laid over each other: along the columns, which stand upright, and as a share of the way from the
// floor to the ceiling. Between two columns floor and ceiling are straight, as the faces of the cells are.
#pragma once

#include <array>
#include <vector>

#include "core/box_mesh.hpp"

namespace lampblack::app::flowcase {

class BoxPlaces {
 public:
  // Of a bent plane box.
  explicit BoxPlaces(const MeshSpec& mesh);
  // The same of the vertices of its mesh (m, three coordinates each), along the columns first. InputError where they
  // are not those of such a box.
  explicit BoxPlaces(const std::vector<double>& vertices);

  // x (m) and the share of the height, 0 to 1.
  [[nodiscard]] std::array<double, 2> of(double x, double y) const;
  // The middle of the cell of the box in which a place lies, so too.
  [[nodiscard]] std::array<double, 2> middle(double x, double y) const;
  // m, the largest distance between floors and between ceilings of this and of another box, at this one's columns
  // as far as the other reaches.
  [[nodiscard]] double apart(const BoxPlaces& other) const;
  // m, by how much the floor or the ceiling rises and falls, whichever does more.
  [[nodiscard]] double rise() const;

 private:
  [[nodiscard]] std::array<double, 2> heights(double x) const;  // m, of floor and ceiling

  std::vector<double> columns_, low_, high_;  // m, of each column
  std::vector<double> rows_;                  // shares of the height, 0 to 1
};

}  // namespace lampblack::app::flowcase
