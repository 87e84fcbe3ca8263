// What becomes of tags when a buffer layer is inserted. [Paper] section 4, step 3.
#pragma once

#include "pillowmesh/refine/buffer_layer.h"
#include "pillowmesh/refine/edge_tags.h"

namespace pillowmesh {

/// Gives the new cells their tags: both copies of a hull edge inherit its tag, except that the shrunk copy of a corner
/// edge does not. Corner edges are contiguous hull edges of one cell of the shrink set: where a layer ends, the layers
/// across it end too.
///
///      +--t--+--t--+        t  tagged        In 3D: the edges of the two hull facets that are
///      | +---+--t--+        the end cell's   perpendicular to the edge that these share.
///      | | e |  S  |        copy has none
///
/// `facets` are the hull facets of the insertion (work.hull.facets). Cost: linear in the layer.
template <int Dim>
void inherit_tags(const Mesh<Dim>& mesh, const BufferLayer<Dim>& layer, std::span<const HullFacet<Dim>> facets,
                  EdgeTags<Dim>& tags);

}  // namespace pillowmesh
