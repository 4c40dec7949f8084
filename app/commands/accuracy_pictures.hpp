#pragma once
// Charts of the accuracy study.
#include <studies/accuracy_report.hpp>

namespace heml {

/// Writes the charts that the study has values for into the folder: work-precision per scene and element, locking,
/// refinement, features. Throws InputError when a file cannot be written.
std::vector<ReportPicture> write_accuracy_pictures(const std::filesystem::path& folder, const AccuracyStudy& study);

}  // namespace heml
