// The results of a run: one HDF5 file written collectively by all ranks, and an XDMF file beside it that ParaView
// opens. Data are stored in the global numbering of cells and vertices, so that the same run on another number of ranks
// makes the same datasets. Each rank sends its values to the rank that holds their block of the file; every rank, or as
// many as FileStorage says, then writes one contiguous slab. docs/formats.md lists every dataset. All functions are
// collective.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "io/file_storage.hpp"

namespace lampblack::io {

// What every results file says about its origin.
struct RunInfo {
  std::string version;       // Lampblack's, "0.1.0"
  std::string gitHash;       // "unknown" outside a checkout
  std::string deckResolved;  // Deck::resolved()
  std::string date;          // ISO 8601, UTC; empty: now, by rank 0's clock
};

// The mesh as this rank sees it. Global numbers are 0..total-1 and do not depend on the number of ranks.
struct MeshOutput {
  int dimension = 2;
  // Vertices of a cell, in VTK's order: 3 or 4 in a plane; 4, 5, 6 or 8 in space. A mesh of several kinds of cells has
  // the most of any, and others repeat a vertex: a triangle as a quadrilateral, the rest as hexahedra.
  int corners = 4;
  std::vector<std::int64_t> globalCell;    // owned cells; each cell of the mesh is owned by exactly one rank
  std::vector<std::int64_t> globalVertex;  // vertices this rank knows; every vertex is known to at least one rank
  std::vector<double> vertexCoordinates;   // 3 for each of globalVertex, m
  std::vector<std::int64_t> connectivity;  // owned cells x vertices of a cell, global vertex numbers
  std::int64_t totalCells = 0;
  std::int64_t totalVertices = 0;
  std::vector<double> cellVolume;  // owned cells, m^3
  std::vector<double> cellCentre;  // 3 for each owned cell, m
  std::vector<int> owner;          // rank of each owned cell; may be empty: this rank
};

class ResultsWriter {
 public:
  // Creates `path`.part and `path` with the extension .xdmf beside it. InputError where the file cannot be made;
  // std::logic_error (on all ranks) where the mesh does not number each cell exactly once. Later failures to write are
  // NumericsErrors; on a full disk SystemErrors of all ranks, and what was complete stays readable in `path`.part.
  ResultsWriter(MPI_Comm comm, std::filesystem::path path, const RunInfo& run, const MeshOutput& mesh,
                const FileStorage& storage = {});
  // The same without a mesh: tables and datasets only, and no XDMF file.
  ResultsWriter(MPI_Comm comm, std::filesystem::path path, const RunInfo& run);
  ~ResultsWriter();
  ResultsWriter(const ResultsWriter&) = delete;
  ResultsWriter& operator=(const ResultsWriter&) = delete;

  // The mesh has been partitioned anew: what this rank owns from now on.
  void renumber(std::span<const std::int64_t> globalCell);

  // Opens the group /steps/<step>. `time` in s.
  void beginStep(std::int64_t step, double time);
  // One value (or `components` values, cell-major) for each owned cell in the order of MeshOutput::globalCell. Two
  // components are stored as three, the last one zero, because that is what ParaView calls a vector. NaN and infinities
  // are written as they are.
  void cellField(const std::string& name, const std::string& unit, int components, std::span<const double> ownedValues,
                 const std::string& description);
  void cellField(const std::string& name, const std::string& unit, int components,
                 std::span<const std::int64_t> ownedValues, const std::string& description);
  // Ends the step: everything so far is on disk and in the XDMF file, to which the step is appended (xdmf_file.hpp).
  void endStep();

  // How many steps there are.
  [[nodiscard]] std::size_t stepCount() const;
  // Copies the steps from the one of index `first` on to a sealed file (sealed_file.hpp). SystemError on a full disk:
  // nothing is left of it then.
  void saveSteps(const std::filesystem::path& path, std::size_t first) const;
  // Writes the steps of such a file, found whole by sealProblem(), those beyond the last step there is. InputError
  // where they are of another mesh.
  void loadSteps(const std::filesystem::path& path);

  // A table as a group of one-dimensional datasets, one for each column. Rows are rank 0's, row-major.
  void table(const std::string& path, const std::vector<Quantity>& columns, std::span<const double> rows);

  // Any dataset, from the rank that has it; missing groups are made. `dims` and `data` of other ranks are ignored.
  void dataset(const std::string& path, const std::vector<std::int64_t>& dims, std::span<const double> data,
               const std::string& unit, const std::string& description, int fromRank = 0);
  void dataset(const std::string& path, const std::vector<std::int64_t>& dims, std::span<const std::int64_t> data,
               const std::string& unit, const std::string& description, int fromRank = 0);
  // A list of texts, the same on all ranks.
  void texts(const std::string& path, const std::vector<std::string>& values, const std::string& description);
  // Attributes of a group (made if missing) or dataset; the same on all ranks.
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name, double value);
  void attribute(const std::string& path, const std::string& name, std::int64_t value);

  // Finishes the file and gives it its name. Without it (a failed run) closePartial() leaves `path`.part, readable,
  // with every step that ended; the XDMF file then refers to that name. The destructor does closePartial() unless an
  // exception is passing that may be one rank's alone, when a collective call could hang.
  void close();
  void closePartial();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace lampblack::io
