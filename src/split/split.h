#pragma once
// A mesh whose cells are split if they are not valid, so that their parts are.

#include "environment/builder.h"

namespace dsw {

template <int D>
class CellParts;
template <int D>
class PartPoints;

template <int D>
class SplitMesh {
 public:
  /** `env` was read (read_mesh) from `input`, which stays where it is while this lives. Facets of `env` may be cut anew. Throws
   * INVALID_CELL or INVERTED_CELL, with the first cells that can't be split in the report; std::bad_alloc. */
  SplitMesh(Environment<D>& env, const dsw_environment_desc& input, BuildReport& report);

  /** Whether a cell was split. */
  bool has_changed() const { return !types_.empty(); }
  /** Describes all parts: the first one of a cell has the index of the cell, others follow after all cells, in the order of these.
   * The description points into this mesh. */
  const dsw_environment_desc& description() const { return made_; }
  /** Gives for each cell of the description the cell that was given. */
  const Array<uint32_t>& parents() const { return parents_; }

 private:
  class Writer;

  void write(const Environment<D>& env, const dsw_environment_desc& input, const Array<Cell>& cells,
             const CellParts<D>& parts);
  void describe(const Environment<D>& env, const dsw_environment_desc& input, const PartPoints<D>& places);

  Array<uint8_t> types_;
  Array<int64_t> offsets_, connectivity_;
  Array<double> points_;
  Array<int32_t> regions_;
  Array<uint32_t> tags_, parents_;
  dsw_environment_desc made_{};
};

}  // namespace dsw
