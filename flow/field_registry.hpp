// The fields of a flow's state, each declared once: what it is called, how many values it has, and what is done with
// it. Whatever goes over all fields (halo, checkpoints, copies and means of a step, results, checks) goes by these
// declarations; a further field is a member of State and a row here.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

struct FieldDeclaration {
  // Where the values stand and what they are: of each local cell, independent of its size or per volume; of each face,
  // what flows through it; of each owned cell, what operators bring per volume and time.
  enum class Kind { Intensive, PerVolume, FaceFlux, Rate };
  // Values of each: one, the axes of the mesh, the species, the carried scalars; one where the flow swirls or
  // has eddies, else none.
  enum class Width { One, Dimension, Species, Carried, Swirl, Eddies };

  const char* name;  // in results; in messages with blanks
  const char* unit;
  const char* description;
  Kind kind;
  Width width;
  std::vector<double> State::*values = nullptr;
  std::vector<double> State::Balance::*rates = nullptr;  // in place of `values`
  std::vector<double> State::Start::*start = nullptr;    // where its values at the start of a step are kept; null: not
  const char* archived = nullptr;                        // its name in checkpoints; null: it is made anew
  bool isInHalo = false;                                 // neighbours need it
  bool isAveraged = false;  // steps of several sweeps take the mean of the start and of what the last sweep found
  bool isWritten = false;   // among the fields of results
  bool isChecked = false;   // every value has to be a finite number
  bool isWatched = false;   // the flow is not steady while it changes

  [[nodiscard]] std::vector<double>& of(State& state) const { return values ? state.*values : state.balance.*rates; }
  [[nodiscard]] const std::vector<double>& of(const State& state) const {
    return values ? state.*values : state.balance.*rates;
  }
  [[nodiscard]] int widthIn(const State& state) const;
  // How many there are of what has `widthIn` values each.
  [[nodiscard]] int countIn(const Mesh& mesh) const;
  // What a message calls one of its values: "temperature", "mass fraction of OH", the name of a carried scalar.
  [[nodiscard]] std::string nameOf(int component, const State& state, const Mechanism& mechanism) const;
};

[[nodiscard]] std::span<const FieldDeclaration> fieldRegistry();

}  // namespace lampblack::flow
