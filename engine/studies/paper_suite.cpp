#include <fmt/format.h>

#include <heml/mesh/generate.hpp>
#include <heml/mesh/read.hpp>
#include <heml/scenario/scene.hpp>
#include <studies/bench.hpp>
#include <studies/force_timing.hpp>
#include <studies/mass_tensor.hpp>
#include <studies/naive.hpp>
#include <studies/operation_count.hpp>
#include <studies/translation_error.hpp>

namespace heml {
namespace {

/// A column of the paper's Tables 2 and 3.
struct PaperBody {
  const char *name, *asset;  ///< asset: empty for the regular cubes
  int cells;                 ///< of a regular cube
  double milliseconds;       ///< Pentium 4, 3.2 GHz
  double mass_tensor, heml;  ///< operations
};
constexpr PaperBody paper_bodies[] = {{"Reg. Cube1", "", 4, 0.25, 2999e3, 70e3},
                                      {"Reg. Cube2", "", 9, 3.5, 36198e3, 787e3},
                                      {"Irreg. Cube", "irregular_cube", 0, 0.34, 3935e3, 89e3},
                                      {"Kidney", "kidney", 0, 2.1, 96292e3, 449e3},
                                      {"Uterus", "uterus", 0, 20.0, 318707e3, 2500e3}};

constexpr const char* heml_note =
    "246 a tetrahedron, an eighth more than the paper's 216 to 219: our element code makes the invariants and A G A as "
    "for any law of I1 and I2, the paper's is written for this law alone";
constexpr const char* printed_sums_note =
    "equation (3) over all neighbours, with U_k·U_j taken once for all l: taken anew for each it would be 1.7 times as "
    "much, as the paper has it of the regular cubes. The rest is the mesh: the count goes with the cube of a node's "
    "neighbours, and those of the paper's kidney and uterus, which are not public, must have been more";
constexpr const char* laws_note =
    "the element's code of each law, divisions, roots, exponentials and logarithms counted apart";
constexpr const char* careful_sums_note =
    "equation (3) without the coefficients that are zero because their nodes share no tetrahedron";

TetMesh mesh_of(const PaperBody& body) {
  if (body.cells > 0) return make_box(Vec3(0.1, 0.1, 0.1), {body.cells, body.cells, body.cells});
  return read_tet_mesh(assets_folder() / "meshes" / (std::string(body.asset) + ".mesh"));
}

BenchRow row_of(const BenchBody& body, std::string name, const std::string& precision) {
  BenchRow row;
  row.name = std::move(name);
  row.mesh = body.name;
  row.nodes = body.mesh.nodes.size();
  row.tets = body.mesh.tets.size();
  row.law = "stvk";
  row.precision = precision;
  return row;
}

BenchRow count_row(const BenchBody& body, std::string name, const Operations& operations, double printed,
                   const char* note) {
  BenchRow row = row_of(body, std::move(name), "");
  row.median = row.min = static_cast<double>(operations.multiplications_and_additions());
  row.unit = "operations";
  row.more = {{"multiplications", operations.multiplications},
              {"additions", operations.additions},
              {"divisions", operations.others}};
  if (printed > 0) {
    row.more["printed"] = printed;
    row.remark = fmt::format("printed: {:.0f}", printed);
  }
  row.more["note"] = note;
  return row;
}

BenchRow time_row(const BenchBody& body, std::string name, const std::string& precision, const Timing& time) {
  BenchRow row = row_of(body, std::move(name), precision);
  row.median = 1e3 * time.median;
  row.min = 1e3 * time.min;
  row.unit = "ms";
  row.more = {{"spread", time.spread}, {"samples", time.samples}};
  return row;
}

Operations mass_tensor_operations(const BenchBody& body, double lambda, double mu, MassTensorSums sums) {
  const MassTensor<CountingScalar> method(body.mesh, lambda, mu, sums);
  const std::vector<CountingScalar> x(body.x.begin(), body.x.end());
  std::vector<CountingScalar> f(x.size());
  return operations_of([&] { method.forces(x.data(), f.data()); });
}

std::vector<BenchRow> count_rows(const BenchBody& body, const PaperBody& paper, const Material& material) {
  const double lambda = material.parameters[0], mu = material.parameters[1];
  return {count_row(body, "HEML", force_operations(body.mesh, material, body.x.data()), paper.heml, heml_note),
          count_row(body, "Mass-Tensor", mass_tensor_operations(body, lambda, mu, MassTensorSums::as_printed),
                    paper.mass_tensor, printed_sums_note),
          count_row(body, "Mass-Tensor, no zeros",
                    mass_tensor_operations(body, lambda, mu, MassTensorSums::without_zeros), 0, careful_sums_note)};
}

/// Operations of every continuum law on the same body.
std::vector<BenchRow> law_rows(const BenchBody& body) {
  std::vector<BenchRow> rows;
  for (const Material& material : bench_materials()) {
    if (!find_law(material.law)->is_continuum) continue;
    const Operations operations = force_operations(body.mesh, material, body.x.data());
    BenchRow row = count_row(body, "HEML", operations, 0, laws_note);
    row.law = material.law;
    row.more["a_tetrahedron"] = Json::array();
    for (const long count : {operations.multiplications, operations.additions, operations.others})
      row.more["a_tetrahedron"].push_back(static_cast<double>(count) / static_cast<double>(row.tets));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Appends one force evaluation by Mass-Tensor for each kind of sums.
template <class Real>
void add_mass_tensor(const BenchBody& body, const Material& material, std::vector<std::function<void()>>& works) {
  for (const MassTensorSums sums : {MassTensorSums::as_printed, MassTensorSums::without_zeros}) {
    const auto method =
        std::make_shared<MassTensor<Real>>(body.mesh, material.parameters[0], material.parameters[1], sums);
    const auto x = std::make_shared<std::vector<Real>>(as_reals<Real>(body.x));
    const auto f = std::make_shared<std::vector<Real>>(x->size());
    works.push_back([=] { method->forces(x->data(), f->data()); });
  }
}

std::vector<BenchRow> time_rows(const BenchBody& body, const PaperBody& paper, const Material& material,
                                const TimingLimits& limits) {
  std::vector<BenchRow> rows;
  for (const ForceTiming& timing : time_forces(body, material, limits)) {
    BenchRow row = time_row(body, timing.naive ? "naive" : "HEML", timing.precision, timing.time);
    row.isa = timing.isa;
    row.threads = timing.threads;
    if (!timing.naive) {
      row.ratio_to_naive = timing.ratio_to_naive;
      row.more["printed"] = paper.milliseconds;
      row.remark = fmt::format("printed: {}", paper.milliseconds);
      row.more["note"] = "the paper's were measured on a Pentium 4 of 3.2 GHz, without optimisation (its section 3.1)";
    }
    rows.push_back(std::move(row));
  }
  const NaiveForces naive(body.mesh, material);
  std::vector<double> f(body.x.size());
  std::vector<std::function<void()>> works = {[&] { naive(body.x.data(), f.data()); }};
  add_mass_tensor<double>(body, material, works);
  add_mass_tensor<float>(body, material, works);
  const auto times = time_interleaved(works, limits);
  for (std::size_t k = 1; k < times.size(); ++k) {
    BenchRow row =
        time_row(body, k % 2 ? "Mass-Tensor" : "Mass-Tensor, no zeros", k < 3 ? "double" : "float", times[k]);
    row.isa = "portable";
    row.ratio_to_naive = times[0].min / times[k].min;
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Adds the force errors of a translated body to the one-thread rows of HEML and Mass-Tensor.
template <class Real>
void add_carried_error(const BenchBody& body, const Material& material, const char* precision,
                       std::vector<BenchRow>& rows) {
  const auto points = translation_errors<Real>(body, material);
  for (BenchRow& row : rows) {
    if (row.unit != "ms" || row.precision != precision || row.threads != 1) continue;
    const bool is_heml = row.name == "HEML";
    if (!is_heml && row.name != "Mass-Tensor") continue;
    Json list = Json::array();
    for (const TranslationError& at : points) list.push_back({at.sizes, is_heml ? at.heml : at.mass_tensor});
    row.more["error_when_carried"] = list;
  }
}

}  // namespace

std::vector<BenchRow> paper_suite(const BenchOptions& options) {
  std::vector<BenchRow> rows;
  const Material material = bench_material("stvk");
  double done = 0;
  for (const PaperBody& paper : paper_bodies) {
    options.progress(fmt::format("paper: {}", paper.name), done++ / std::size(paper_bodies));
    const BenchBody body = bench_body(paper.name, mesh_of(paper));
    TimingLimits limits;
    limits.seconds = options.quick ? 0.4 : 3;
    limits.min_rounds = 3;
    std::vector<BenchRow> of_body = count_rows(body, paper, material);
    for (BenchRow& row : time_rows(body, paper, material, limits)) of_body.push_back(std::move(row));
    add_carried_error<double>(body, material, "double", of_body);
    add_carried_error<float>(body, material, "float", of_body);
    if (&paper == &paper_bodies[0]) {
      for (BenchRow& row : law_rows(body))
        if (row.law != material.law)
          of_body.push_back(std::move(row));
        else
          of_body.front().more["a_tetrahedron"] = row.more["a_tetrahedron"];
    }
    rows.insert(rows.end(), of_body.begin(), of_body.end());
  }
  return rows;
}

}  // namespace heml
