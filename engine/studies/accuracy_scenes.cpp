// Which scenes are studied, on which meshes, and how widely.
#include <heml/studies/accuracy_study.hpp>

namespace heml {
namespace {

/// A scene file of the study and what is done with it.
struct Entry {
  const char* file;  ///< below assets/
  int halvings;      ///< every tetrahedron in eight so many times
  SceneStudyOptions options;
  double weight;     ///< s it took where this was written
};

constexpr SceneStudyOptions whole{}, brief{Sweep::brief};

const Entry quick_entries[] = {{"studies/accuracy/beam.json", 0, {Sweep::brief, true, 50000}, 20}};

const Entry full_entries[] = {{"studies/accuracy/beam.json", 0, whole, 60}};

AccuracyScene scene_of(const Entry& entry) {
  Specimen specimen = specimen_of(read_scene(assets_folder() / entry.file));
  for (int k = 0; k < entry.halvings; ++k) specimen = finer(specimen);
  return {specimen.scene.name, std::move(specimen), entry.options, entry.weight};
}

}  // namespace

std::vector<AccuracyScene> accuracy_scenes(bool quick) {
  std::vector<AccuracyScene> scenes;
  if (quick)
    for (const Entry& entry : quick_entries) scenes.push_back(scene_of(entry));
  else
    for (const Entry& entry : full_entries) scenes.push_back(scene_of(entry));
  return scenes;
}

}  // namespace heml
