// Layers: contiguous cells connected by parallel tagged edges. [Paper] section 4, step 2, Figures 2 to 4.
#pragma once

#include <limits>
#include <vector>

#include "pillowmesh/refine/buffer_layer.h"
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

/// Marks per cell that finding layers needs, a bit per axis; grown on demand.
struct LayerMarks {
  std::vector<std::uint8_t> visited;  ///< all zero between calls
  /// Axes along which this iteration has refined the cell already: thicker layers leave such cells out.
  std::vector<std::uint8_t> refined;
};

/// Grows the layer of the tagged edge `seed`: through parallel tagged edges as far as they go; the cells at its ends have
/// one tagged edge in that direction. Removes the tags of all the edges used.
///
///        .   .   .   .   .   .   .          |  tagged edge
///        .   .   |   |   |   .   .          a  augmented, e  end, o  inner cell
///          a   e   o   o   e   a
///
/// With thickness 2 the row beside it that carries more tags is shrunk too, and each row is halved: 2 rows become 4. Only
/// rows next to the hull are refined. So a row joins as a whole or not at all: not if it is the last before the boundary,
/// not if this iteration has refined it already, and not if it carries less than half as many tags.
///
/// Cost: linear in the layer. \pre tags.has(seed)
template <int Dim>
void find_layer(const Mesh<Dim>& mesh, EdgeTags<Dim>& tags, CellEdge seed, const LayerOptions& options,
                LayerMarks& marks, Layer& layer);

/// Notes what inserting the layer has refined: its cells along their axes, the new cells across the hull.
/// `insertion` is the buffer layer around it, `facets` its hull. Cost: linear in the layer.
template <int Dim>
void mark_refined(const Mesh<Dim>& mesh, const Layer& layer, const BufferLayer<Dim>& insertion,
                  std::span<const HullFacet<Dim>> facets, LayerMarks& marks);

}  // namespace pillowmesh
