#pragma once
// Removes specks from a label map: components of a label too small to be meant.
#include <heml/mesh/labels/label_map.hpp>

namespace heml {

/// Crops the map to its labels, with one voxel outside round them.
void crop(LabelMap& map);

/// Gives each component (of voxels that share faces) below 8 voxels or 0.1 % of its label to what borders most on it;
/// holes in the labels likewise. Warns how many. The map has a layer of voxels outside round it.
void remove_specks(LabelMap& map);

/// Number of voxels of each label (map.values).
std::vector<std::size_t> count_labels(const LabelMap& map);

}  // namespace heml
