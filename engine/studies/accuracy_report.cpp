#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <studies/accuracy_report.hpp>
#include <studies/machine.hpp>

namespace heml {
namespace {

void add_pictures(HtmlPage& page, const std::vector<ReportPicture>& pictures, const std::string& part) {
  for (const ReportPicture& picture : pictures)
    if (picture.part == part) page.png(picture.file, picture.caption);
}

std::string reference_text(const TimeStudy& time) {
  const Reference& reference = time.reference;
  if (!reference.failure.empty()) return fmt::format("{}: no reference: {}.", time.problem, reference.failure);
  std::size_t unresolved = 0;
  for (const Measured& m : time.measured) unresolved += !m.failed() && !m.resolved;
  return fmt::format(
      "{}: errors of time are measured from verlet in double with steps of {:.3g} µs on the same mesh; twice those "
      "steps move it by {}, so errors from {} on can be told{}. The body moves by {} (rms).",
      time.problem, 1e6 * reference.step, length_text(reference.change), length_text(reference.resolution()),
      unresolved ? fmt::format(" ({} of {} runs are closer than that, and marked <)", unresolved, time.measured.size())
                 : std::string(),
      length_text(reference.motion));
}

std::string mesh_convergence_text(const MeshConvergenceStudy& convergence) {
  const Extrapolation& e = convergence.reference;
  if (!e.failure.empty()) return fmt::format("The error of the mesh is not known: {}.", e.failure);
  std::string text = fmt::format(
      "Errors of the mesh are of the body at rest under its loads, measured from {} meshes, each with every "
      "tetrahedron of the one before in eight, extrapolated ({}, orders {:.2f} and {:g}, the middle of both; ± {})",
      e.meshes, e.element, e.low, e.high, length_text(e.uncertainty));
  if (e.between_elements)
    text += fmt::format("; those of other elements differ by up to {}", length_text(*e.between_elements));
  return text + ". The surface is that of the mesh as it is.";
}

void add_scene(HtmlPage& page, const SceneStudy& scene, const std::vector<ReportPicture>& pictures) {
  page.heading(scene.title);
  page.paragraph(fmt::format("{}: {} nodes, {} tetrahedra, {}.", scene.name, scene.time.front().nodes,
                             scene.time.front().tets, fmt::join(scene.laws, ", ")));
  add_pictures(page, pictures, scene.name);
  page.paragraph("What nothing tried beats:");
  page.table(front_table(scene));
  for (const std::string& note : scene.notes) page.paragraph(note + ".");
  for (const TimeStudy& time : scene.time) {
    page.paragraph(reference_text(time));
    if (!time.measured.empty())
      page.details(fmt::format("All {} runs, {}", time.measured.size(), time.problem), time_table(time));
  }
  page.paragraph(mesh_convergence_text(scene.convergence));
  if (!scene.convergence.meshes.empty()) page.details("Meshes at rest", mesh_convergence_table(scene.convergence));
}

void add_locking(HtmlPage& page, const std::vector<LockingBeam>& beams, const std::vector<ReportPicture>& pictures) {
  page.heading("Locking");
  page.paragraph(
      "A beam of 10 × 2 × 2 cm that sags by 0.7 % of its length, held against Timoshenko's theory and against itself "
      "on "
      "finer meshes. What an error grows by from one Poisson's ratio to another on the same mesh is locking; theory "
      "does not know that the clamp also holds the section back, hence the last per cent at ratios other than 0.");
  add_pictures(page, pictures, "locking");
  page.table(locking_table(beams));
}

/// Compares the finest uniform mesh with the first adapted one whose error is no larger.
std::string gain_of(const RefinementStudy& study) {
  const RefinedMesh* uniform = nullptr;
  for (const RefinedMesh& mesh : study.meshes)
    if (!mesh.adapted) uniform = &mesh;
  for (const RefinedMesh& mesh : study.meshes)
    if (uniform && mesh.adapted && mesh.error <= uniform->error)
      return fmt::format("the {} tetrahedra of the finest uniform mesh err no less than {} adapted ones", uniform->tets,
                         mesh.tets);
  return "no adapted mesh allowed here errs as little as the finest uniform one";
}

void add_refinement(HtmlPage& page, const RefinementStudy& study, const std::vector<ReportPicture>& pictures) {
  page.heading("Refining where the estimate says");
  page.paragraph(
      fmt::format("The same beam at Poisson's ratio {}, on meshes with every tetrahedron in eight, and on meshes whose "
                  "few elements "
                  "with half of the squared estimate are cut again and again (`heml refine`): {}.",
                  study.poisson, gain_of(study)));
  add_pictures(page, pictures, "refinement");
  page.table(refinement_table(study));
}

/// Distribution of the effectivities of the step-doubling estimate over all runs.
std::string spread_of_time_estimates(const AccuracyStudy& study) {
  std::vector<double> estimates;
  for (const SceneStudy& scene : study.scenes)
    for (const TimeStudy& time : scene.time)
      for (const Measured& m : time.measured)
        if (m.step_doubling) estimates.push_back(*m.step_doubling);
  if (estimates.empty()) return "none of the runs could be followed";
  std::sort(estimates.begin(), estimates.end());
  const auto honest = std::count_if(estimates.begin(), estimates.end(), [](double g) { return g >= 0.5 && g <= 2; });
  return fmt::format("of {} runs {} are between 0.5 and 2; half of all between {:.2f} and {:.2f}", estimates.size(),
                     honest, estimates[estimates.size() / 4], estimates[estimates.size() * 3 / 4]);
}

void add_estimates(HtmlPage& page, const AccuracyStudy& study) {
  page.heading("What the panel's gauges are worth");
  page.paragraph(
      "The panel estimates both errors while a body runs. Effectivity is estimate over error; from 0.5 to 2 it is "
      "honest. Of the mesh: stress and deformation against linear fits round nodes (Zienkiewicz and Zhu), held against "
      "the "
      "energy norm of the error that the potentials of finer meshes tell, linear tetrahedra alone. The last two "
      "columns "
      "are lengths: the share of the motion that is the share of the energy, against the error on finer meshes.");
  page.table(error_estimate_table(study));
  page.paragraph(
      "Of the steps: a shadow with half the steps, from the start to the first set time, held against the reference "
      "(\"gauge\" in the tables of runs): " +
      spread_of_time_estimates(study) + ".");
}

void add_laws(HtmlPage& page, const std::vector<LawCheck>& laws) {
  page.heading("Laws");
  page.paragraph(
      "A small cube of each law settles under its weight, its top turned and moved. Then a naive loop, F = Ds Dm⁻¹, P "
      "= F "
      "S, with stresses written out from textbooks apart from the engine's, takes the forces there: what they leave "
      "over on free nodes beside the weight.");
  page.table(law_table(laws));
}

void add_features(HtmlPage& page, const FeatureStudy& study, const std::vector<ReportPicture>& pictures) {
  page.heading("What features cost: " + study.title);
  page.paragraph(
      fmt::format("{}, {:.3g} s of it, with one thing changed at a time (`heml explain --measure`): computing time, "
                  "and how far the "
                  "nodes (rms) are in the end from where they are in the scene as it is. Nodes move by {} at most.",
                  study.scene, study.measurement.stretch, length_text(study.measurement.max_motion)));
  add_pictures(page, pictures, "features " + study.scene);
  page.table(feature_table(study));
}

void add_method(HtmlPage& page, const std::string& command) {
  const Machine machine = this_machine();
  page.heading("How this was made");
  page.command(command);
  page.paragraph(
      fmt::format("heml {} ({}), {}, {}, {} cores, {}. Times are of this machine and of what else it did; "
                  "errors are not.",
                  machine.version, machine.commit, machine.compiler, machine.cpu, machine.cores, machine.flags));
  page.paragraph(
      "A frame is 1/60 s of simulated time. Errors are rms over the body, weighted by mass, at the set time where they "
      "are largest; the error of a method is that of time (same mesh, same element, against tiny steps) plus that of "
      "the mesh (at rest, against finer meshes). No reference is a method of the table or adjusted to one. `runs.csv` "
      "beside this file has every run.");
}

}  // namespace

std::vector<std::string> answers_of(const AccuracyStudy& study) {
  std::vector<std::string> answers;
  for (const SceneStudy& scene : study.scenes)
    for (const double budget : frame_budgets)
      answers.push_back(fmt::format("{}: {}.", scene.name, answer_within(scene.candidates(), budget)));
  return answers;
}

std::string accuracy_page(const AccuracyStudy& study, const std::vector<ReportPicture>& pictures,
                          const std::string& command, const std::vector<std::string>& worse) {
  HtmlPage page("Error against run time");
  for (const std::string& answer : answers_of(study)) page.answer(answer);
  if (!worse.empty()) {
    page.heading("Worse than before");
    for (const std::string& sentence : worse) page.paragraph(sentence);
  }
  for (const SceneStudy& scene : study.scenes) add_scene(page, scene, pictures);
  if (!study.locking.empty()) add_locking(page, study.locking, pictures);
  if (study.refinement && !study.refinement->meshes.empty()) add_refinement(page, *study.refinement, pictures);
  add_estimates(page, study);
  if (!study.laws.empty()) add_laws(page, study.laws);
  for (const FeatureStudy& features : study.features) add_features(page, features, pictures);
  add_method(page, command);
  return page.text();
}

}  // namespace heml
