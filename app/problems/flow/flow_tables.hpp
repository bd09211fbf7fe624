// Tables of a flow: fields at probes and boundaries' sums, a row each row of the history; fields along lines, what the
// faces of walls have taken of the particles, and what operators tell of regions, at each output. A CSV file each in
// the folder `tables` of the run, and a group each of the results (docs/formats.md).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/problems/flow/flow_case.hpp"
#include "core/mesh_region.hpp"
#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/models/deposition_operator.hpp"
#include "flow/operator.hpp"
#include "flow/paths/field_sampler.hpp"
#include "flow/state.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "io/checkpoint_file.hpp"
#include "io/history.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

class FlowTables {
 public:
  // What the rows are taken from.
  struct Source {
    const State& state;
    TransportOperator& transport;
    const std::vector<Operator*>& operators;
    const DepositionOperator* deposition = nullptr;  // null: walls take nothing
  };
  struct Moment {
    std::int64_t step = 0;
    double time = 0.0;  // s
  };

  // Collective. InputError, which points into the deck, for a place outside the mesh and a quantity that is none.
  FlowTables(const FlowContext& context, const FlowCase& flowCase, const Source& source);

  // Collective, as all below. Goes on with a flow whose mesh has been partitioned anew; before rows of it.
  void moveTo(const FlowContext& context);
  // Begins the files, with what was loaded.
  void open(const RunFolder& folder);
  // Of probes and boundaries, with a row of the history.
  void historyRow(const Moment& moment, const Source& source);
  // Of lines, walls' faces and regions, with an output.
  void outputRows(const Moment& moment, const Source& source);
  void writeTo(ResultsWriter& results) const;

  // The rows so far. A table that the loaded run did not have, or had with other columns, begins where it is loaded.
  void save(CheckpointWriter& archive) const;
  void load(CheckpointReader& archive);

 private:
  struct Table {
    std::string kind, name;  // "probe", "wake"; of regions Operator::RegionTable::kind
    std::string group;       // of the results
    std::vector<Quantity> columns;
    [[nodiscard]] std::string id() const { return kind + "_" + name; }
    [[nodiscard]] std::string header() const;  // what tells it from others
  };
  // A component of a field, and its place in the tables.
  struct Wanted {
    Quantity column;
    std::string field;
    int component = 0;
  };

  void chooseQuantities(const Source& source);
  void makeRegions();
  void requireInside(const FieldSampler& sampler, const std::function<std::string(int)>& keyOf,
                     const std::string& what) const;
  [[nodiscard]] std::vector<FieldSampler::Field> fieldsOf(const Source& source) const;
  [[nodiscard]] std::vector<Quantity> columnsOf(const std::vector<Quantity>& first) const;
  [[nodiscard]] std::vector<Quantity> boundaryColumns(std::size_t boundary) const;
  // Of the boundaries that are asked for, those whose faces have a table.
  [[nodiscard]] std::vector<std::size_t> deposits() const;
  [[nodiscard]] std::vector<std::size_t> walls() const;  // the same of friction and heat

  const FlowContext* context_;
  const FlowCase& case_;
  std::vector<Wanted> wanted_;
  std::unique_ptr<FieldSampler> probes_;  // a place a probe; null without any
  std::vector<FieldSampler> lines_;
  std::vector<MeshRegion> regions_;
  bool hasDeposition_;
  std::vector<Table> tables_;  // probes, boundaries, lines, walls' faces, regions
  std::vector<HistoryWriter> writers_;
  std::map<std::string, std::vector<double>> loaded_;  // rows by header
};

}  // namespace lampblack::app
