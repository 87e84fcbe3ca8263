// Layers: contiguous cells connected by parallel tagged edges. [Paper] section 4, step 2, Figures 2 to 4.
#pragma once

#include <limits>
#include <vector>

#include "pillowmesh/refine/edge_tags.h"

namespace pillowmesh {

struct LayerOptions {
  int augment = 1;    ///< rings of cells added at the ends, perpendicular to the refinement
  int thickness = 1;  ///< cells across
  /// No ring is added through cells from this number on: those that this iteration has made are small already.
  CellId first_new = std::numeric_limits<CellId>::max();
};

/// A cell of a layer, the axis along which the layer is refined there, and which side of that axis is "up".
struct LayerCell {
  CellId cell;
  std::int8_t axis;
  std::int8_t up;
};

/// A layer. A self-intersecting layer visits a cell once per axis. Buffers are reused from call to call.
struct Layer {
  std::vector<LayerCell> visits;
  std::vector<CellId> cells;      ///< each once: the shrink set
  std::vector<CellEdge> edges;    ///< the tagged edges that formed it, each once
};

/// Marks per cell that finding layers needs; all zero between calls, grown on demand.
struct LayerMarks {
  std::vector<std::uint8_t> visited;  ///< bit per axis
};

/// Grows the layer of the tagged edge `seed`: through parallel tagged edges as far as they go; the cells at its ends have
/// one tagged edge in that direction. Removes the tags of all the edges used.
///
///        .   .   .   .   .   .   .          |  tagged edge
///        .   .   |   |   |   .   .          a  augmented, e  end, o  inner cell
///          a   e   o   o   e   a
///
/// Cost: linear in the layer. \pre tags.has(seed)
template <int Dim>
void find_layer(const Mesh<Dim>& mesh, EdgeTags<Dim>& tags, CellEdge seed, const LayerOptions& options,
                LayerMarks& marks, Layer& layer);

}  // namespace pillowmesh
