#pragma once
// What was found wrong with a bare mesh, and what became of it, as a list for people: BareMeshChoices::findings.
#include <heml/mesh/mend/mend.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/scenario/scene.hpp>
#include <vector>

namespace heml {

/// Of a surface that was mended, in the order of its repairs.
std::vector<BareMeshChoices::Finding> findings_of(const MendReport& report);

/// Of tetrahedra, as they were read or filled. report: of them. improved: of the mesh that was made of them by
/// improve(); null: the body is of them as they are.
std::vector<BareMeshChoices::Finding> findings_of(const TetMesh& mesh, const QualityReport& report,
                                                  const QualityReport* improved);

}  // namespace heml
