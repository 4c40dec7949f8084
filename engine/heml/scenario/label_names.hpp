#pragma once
// Names of the labels of a label map.
#include <filesystem>
#include <map>
#include <string>

namespace heml {

/// Names by the labels' numbers: those of the file's header (label_map.hpp), and over them those of a file beside it,
/// the first there is of, for scan.nii.gz:
///
///     scan.json      {"1": "liver"}, {"liver": 1}, or either under "labels"
///     scan.txt       ITK-SNAP's descriptions: 1 255 0 0 1 1 1 "liver"
///     scan.label     the same
///
/// Labels without a name are not in it. Throws InputError for a header that cannot be read; a file of names that cannot
/// be read is warned of.
std::map<int, std::string> label_names(const std::filesystem::path& label_map);

}  // namespace heml
