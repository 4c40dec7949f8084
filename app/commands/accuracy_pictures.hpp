#pragma once
// The accuracy study, drawn.
#include <studies/accuracy_report.hpp>

namespace heml {

/// Writes into the folder what the study has numbers for: a work-precision diagram a scene and element, and error
/// against tetrahedra for every Poisson's ratio. Throws InputError when a file cannot be written.
std::vector<ReportPicture> write_accuracy_pictures(const std::filesystem::path& folder, const AccuracyStudy& study);

}  // namespace heml
