#include <algorithm>
#include <atomic>
#include <cmath>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/body.hpp>
#include <heml/elastic/bsr_matrix.hpp>
#include <heml/elastic/clamp.hpp>
#include <heml/elastic/stiffness_product.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <mutex>

namespace heml {
namespace {

/// J σ = F S Fᵀ + wJ J I. Von Mises stress and largest stretch are invariant to rotation, so √C replaces F.
template <class Real>
ElementState<Real> state_of(const StressSum<Real>& stress, const Real C[6], Real J) {
  const auto e = symmetric_eigen3(C);
  const Real largest = std::max({e.value[0], e.value[1], e.value[2]});
  Real root[3], U[6], T[6];
  for (int i = 0; i < 3; ++i) root[i] = std::sqrt(std::max(e.value[i], Real(0)));
  spectral_sum3(e, root, U);
  const Real M[3][3] = {{U[0], U[3], U[4]}, {U[3], U[1], U[5]}, {U[4], U[5], U[2]}};
  congruence3(M, stress.S, T);
  const Real mean = (T[0] + T[1] + T[2]) / 3;
  for (int i = 0; i < 3; ++i) T[i] -= mean;
  return {J, std::sqrt(std::max(largest, Real(0))), std::sqrt(Real(1.5) * double_contraction3(T, T)) / std::abs(J)};
}

template <class Real>
bool is_finite(const Tensions<Real>& t) {
  return std::isfinite(t.wJ) && std::all_of(std::begin(t.T), std::end(t.T), [](Real T) { return std::isfinite(T); });
}

/// Instruction set of the HEML_WIDE loops on this processor.
std::string_view wide_instructions() {
#if defined(__x86_64__)
  if (has_avx2()) return "avx2";
#endif
  return "portable";
}

}  // namespace

template <class Real>
ElasticBody<Real>::ElasticBody(const TetMesh& mesh, const std::vector<int>& material_of,
                               const std::vector<Material>& materials, BodyOptions options)
    : mesh_(mesh),
      material_of_(material_of),
      materials_(materials),
      options_(options),
      springs_(mesh, std::vector<double>(mesh.tets.size(), 0.0)) {
  make_parts();
  make_fans();
  reset_history(at_rest().data());
}

template <class Real>
std::vector<Real> ElasticBody<Real>::at_rest() const {
  std::vector<Real> x;
  for (const Vec3& X : mesh_.nodes)
    for (const double value : X) x.push_back(static_cast<Real>(value));
  return x;
}

template <class Real>
void ElasticBody<Real>::make_parts() {
  parts_.clear();
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    std::vector<int> elements;
    for (std::size_t t = 0; t < material_of_.size(); ++t)
      if (material_of_[t] == static_cast<int>(m)) elements.push_back(static_cast<int>(t));
    if (!elements.empty()) parts_.push_back(make_part(m, elements));
  }
  join_parts();
}

/// The fan kernels run a law unless its parameters (fields) or rest shapes (plasticity) vary by element.
template <class Real>
typename ElasticBody<Real>::Part ElasticBody<Real>::make_part(std::size_t index,
                                                              const std::vector<int>& elements) const {
  const Material& material = materials_[index];
  Part part{index,
            make_group<Real>(mesh_, elements, material),
            make_terms<Real>(material, options_.continuation, options_.nodal_pressure),
            nullptr,
            {},
            false};
  part.group.density = static_cast<Real>(material.density);
  for (const auto& term : part.terms) term->begin_step(step_);
  part.flow = make_flow<Real>(material, options_.continuation, part.group);
  part.in_fans = !part.terms.empty() && material.fields.empty() && !part.flow;
  return part;
}

/// Rebuilds what depends on all parts together, except the fans.
template <class Real>
void ElasticBody<Real>::join_parts() {
  std::vector<ElementGroup<Real>*> groups;
  for (Part& part : parts_) groups.push_back(&part.group);
  corners_ = map_corners(groups, mesh_.nodes.size());
  corner_.assign(3 * corner_count(groups), Real(0));
  force_corners_ = {std::vector<std::size_t>(nodes() + 1, 0), {}};
  const auto has_loops = [&](const Part& part) { return part.has_loops(options_.nodal_pressure); };
  const auto is_in_loops = [&](std::size_t corner) {
    return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) {
      const std::size_t first = part.group.first_corner;
      return has_loops(part) && corner >= first && corner < first + 4 * part.group.volume.size();
    });
  };
  const bool any_loops = std::any_of(parts_.begin(), parts_.end(), has_loops);
  for (std::size_t n = 0; n < nodes() && any_loops; ++n) {
    for (std::size_t k = corners_.start[n]; k < corners_.start[n + 1]; ++k)
      if (is_in_loops(corners_.corners[k])) force_corners_.corners.push_back(corners_.corners[k]);
    force_corners_.start[n + 1] = force_corners_.corners.size();
  }
  make_shared();
}

template <class Real>
std::vector<FanPart> ElasticBody<Real>::fan_parts() const {
  std::vector<FanPart> parts;
  for (const Part& part : parts_) {
    const Material& material = materials_[part.material];
    const bool isochoric = options_.nodal_pressure || material.volume_term != VolumeTerm::quadratic;
    if (part.in_fans) parts.push_back({&part.group.element, &material, isochoric});
  }
  return parts;
}

template <class Real>
void ElasticBody<Real>::make_fans() {
  fans_ = {};
  const std::vector<FanPart> parts = fan_parts();
  if (parts.empty()) return;
  ThreadTeam team = layout_team();
  fans_ = FanForces<Real>(mesh_, parts, options_.continuation, options_.instruction_set, team);
}

/// Updates the fans to the present mesh, whose element t is origins[t] of the mesh `before` or a piece of it.
template <class Real>
void ElasticBody<Real>::update_fans(const TetMesh& before, const std::vector<int>& origins) {
  const std::vector<FanPart> parts = fan_parts();
  ThreadTeam team = layout_team();
  if (parts.empty() || !fans_.update_layout(before, mesh_, parts, origins, team)) make_fans();
}

/// Rebuilds springs and averaged nodal pressure, which belong to no single element.
template <class Real>
void ElasticBody<Real>::make_shared() {
  std::vector<double> stiffness(mesh_.tets.size(), 0.0);
  for (std::size_t t = 0; t < stiffness.size(); ++t) {
    const Material& material = materials_[static_cast<std::size_t>(material_of_[t])];
    if (!find_law(material.law)->is_continuum) stiffness[t] = material.parameters[0];
  }
  for (const Part& part : parts_)  // stiffness from a field
    if (!find_law(materials_[part.material].law)->is_continuum && !part.group.parameters.empty())
      for (std::size_t s = 0; s < part.group.size(); ++s)
        stiffness[static_cast<std::size_t>(part.group.element[s])] = static_cast<double>(part.group.parameters[0][s]);
  springs_ = Springs<Real>(mesh_, stiffness);
  pressure_.reset();
  if (!options_.nodal_pressure) return;
  std::vector<const ElementGroup<Real>*> groups;
  std::vector<std::vector<Real>> kappa;
  for (const Part& part : parts_) {
    const Material& material = materials_[part.material];
    groups.push_back(&part.group);
    const std::size_t slot = *volume_parameter(material, *find_law(material.law));
    kappa.emplace_back(part.group.volume.size(), static_cast<Real>(material.parameters[slot]));
    for (std::size_t k = 0; k < material.fields.size(); ++k)
      if (material.fields[k].parameter == slot) kappa.back() = part.group.parameters[k];
  }
  const VolumeTerm term = materials_[parts_.front().material].volume_term;
  pressure_ = std::make_unique<NodalPressure<Real>>(std::move(groups), corners_, kappa, term, options_.continuation);
}

template <class Real>
void ElasticBody<Real>::gather_corners(const CornerMap& corners, Real* f, bool add, ThreadTeam& team) const {
  team.parallel_for(nodes(), grain_ / 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      Real sum[3] = {0, 0, 0};
      for (std::size_t k = corners.start[n]; k < corners.start[n + 1]; ++k) {
        const Real* corner = &corner_[3 * corners.corners[k]];
        for (int i = 0; i < 3; ++i) sum[i] += corner[i];
      }
      for (std::size_t i = 0; i < 3; ++i) f[3 * n + i] = add ? f[3 * n + i] + sum[i] : sum[i];
    }
  });
}

template <class Real>
bool ElasticBody<Real>::forces(const Real* x, Real* f, ThreadTeam& team) {
  std::atomic<bool> valid{true};
  if (!fans_.empty()) valid = fans_.forces(x, f, team);
  for (const Part& part : parts_) {
    const std::size_t first = part.first_loop(), corners = part.group.first_corner;
    for (std::size_t k = first; k < part.terms.size(); ++k)
      team.parallel_for(part.group.packets(), grain_ / part.group.lanes, [&](std::size_t begin, std::size_t end) {
        if (!part.terms[k]->forces(part.group, x, begin, end, corner_.data(), k > first))
          valid.store(false, std::memory_order_relaxed);
      });
    if (pressure_ && part.terms.size() == first)  // no term has written these corners
      std::fill_n(corner_.data() + 3 * corners, 12 * part.group.volume.size(), Real(0));
  }
  if (pressure_ && !pressure_->add_forces(x, corner_.data(), team)) valid = false;
  if (fans_.empty() || !force_corners_.corners.empty()) gather_corners(force_corners_, f, !fans_.empty(), team);
  if (!springs_.empty()) springs_.add_forces(x, f, team);
  return valid;
}

template <class Real>
std::vector<KernelInfo> ElasticBody<Real>::kernels() const {
  // Bytes per element and term of the loops: constants and nodes, corner forces written and gathered, positions and
  // forces.
  const double corners = 4 * sizeof(int) + 7 * sizeof(Real) + 4 * (6 * sizeof(Real) + sizeof(std::size_t)) +
                         static_cast<double>(6 * sizeof(Real) * nodes()) / static_cast<double>(elements());
  std::vector<KernelInfo> result;
  for (const Part& part : parts_) {
    const Material& material = materials_[part.material];
    KernelInfo info{part.material, material.law, "corners", "portable", part.group.size(), 0};
    if (part.terms.empty()) {
      info.kernel = "springs";
    } else {
      const bool has_loops = part.has_loops(options_.nodal_pressure);
      if (part.in_fans) {
        info.kernel = has_loops ? "fans and corners" : "fans";
        info.instructions = name_of(fans_.instruction_set());
        info.bytes_per_tet = fans_.bytes_per_tet();
      } else if (material.fields.empty()) {
        info.instructions = wide_instructions();  // elastic/law_term.hpp
      }
      info.bytes_per_tet += corners * static_cast<double>(part.terms.size() - part.first_loop());
    }
    result.push_back(std::move(info));
  }
  return result;
}

template <class Real>
void ElasticBody<Real>::linearise(const Real* x, ThreadTeam& team) {
  linearisation_point_.assign(x, x + 3 * nodes());
  projected_ = false;
  for (Part& part : parts_) {
    part.stiffness.resize(edge_entries * part.group.volume.size());
    for (std::size_t k = 0; k < part.terms.size(); ++k)
      team.parallel_for(part.group.packets(), grain_ / 4 / part.group.lanes, [&](std::size_t begin, std::size_t end) {
        part.terms[k]->stiffness(part.group, x, begin, end, part.stiffness.data(), k > 0);
      });
  }
}

template <class Real>
void ElasticBody<Real>::project(Projection projection, ThreadTeam& team) {
  if (projection != Projection::element && projection != Projection::tension) return;
  projected_ = true;
  for (Part& part : parts_)
    team.parallel_for(part.group.volume.size(), grain_ / 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) {
        Real k[edge_entries];
        read_edge_stiffness(part.stiffness.data(), s, k);
        if (projection == Projection::element) {
          clamp_element(k);
        } else {
          const auto rest = rest_shape(part.group, s);
          const auto kinematics = full_kinematics(part.group, linearisation_point_.data(), s, rest);
          Tensions<Real> sum{};
          for (const auto& term : part.terms) {
            const Tensions<Real> t = term->tensions(part.group, s, kinematics, rest);
            for (int i = 0; i < 6; ++i) sum.T[i] += t.T[i];
            sum.wJ += t.wJ;
          }
          clamp_tension(sum, kinematics, rest, k);
        }
        write_edge_stiffness(k, s, part.stiffness.data(), false);
      }
    });
}

template <class Real>
void ElasticBody<Real>::force_differential(const Real* dx, Real* out, ThreadTeam& team) {
  for (const Part& part : parts_)
    team.parallel_for(part.group.packets(), grain_ / part.group.lanes, [&](std::size_t begin, std::size_t end) {
      multiply_stiffness(part.stiffness.data(), part.group, dx, begin, end, corner_.data());
    });
  const Real* x = linearisation_point_.data();
  if (pressure_) pressure_->add_force_differential(x, dx, corner_.data(), team);
  gather_corners(corners_, out, false, team);
  if (!springs_.empty()) springs_.add_force_differential(x, dx, out, projected_, team);
}

template <class Real>
bool ElasticBody<Real>::add_stiffness(BsrMatrix& rows, ThreadTeam& team) const {
  if (pressure_) return false;
  for (const Part& part : parts_)
    if (!part.terms.empty()) rows.add_elements(part.stiffness.data(), part.group, team);
  each_spring_stiffness([&](int a, int b, const Real(&block)[3][3]) {
    Mat3 B;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) B(i, j) = static_cast<double>(block[i][j]);
    rows.add_edge(a, b, B);
  });
  return true;
}

template <class Real>
void ElasticBody<Real>::element_stiffness(std::size_t p, std::size_t s, ElementMatrix<Real>& K) const {
  const Part& part = parts_[p];
  Real k[edge_entries];
  read_edge_stiffness(part.stiffness.data(), s, k);
  if (pressure_) pressure_->add_stiffness(p, linearisation_point_.data(), s, k);
  expand_edges(k, K);
}

/// Adds packets in ascending order, so that the sum does not depend on the threads.
template <class Real>
double ElasticBody<Real>::sum_energies(const Real* x, bool stored, ThreadTeam& team) {
  double sum = 0;
  for (const Part& part : parts_) {
    packet_energy_.assign(part.group.packets(), 0.0);
    for (const auto& term : part.terms)
      if (term->stores() == stored)
        team.parallel_for(part.group.packets(), grain_ / part.group.lanes, [&](std::size_t begin, std::size_t end) {
          term->energies(part.group, x, begin, end, packet_energy_.data(), true);
        });
    for (const double of_packet : packet_energy_) sum += of_packet;
  }
  return sum;
}

template <class Real>
double ElasticBody<Real>::energy(const Real* x, ThreadTeam& team) {
  double sum = springs_.energy(x) + sum_energies(x, true, team);
  if (pressure_) sum += pressure_->energy(x);
  return sum;
}

template <class Real>
double ElasticBody<Real>::potential(const Real* x, ThreadTeam& team) {
  return energy(x, team) + (has_internal_state() ? sum_energies(x, false, team) : 0.0);
}

/// Maximum over the parts of the sum of the bounds of their terms.
template <class Real>
template <class Bound>
Real ElasticBody<Real>::max_bound(ThreadTeam& team, const Bound& bound) const {
  Real of_all = 0;
  std::mutex mutex;  // a maximum does not depend on the order it is taken in
  for (const Part& part : parts_) {
    Real of_part = 0;
    for (const auto& term : part.terms) {
      Real largest = 0;
      team.parallel_for(part.group.packets(), grain_ / part.group.lanes, [&](std::size_t begin, std::size_t end) {
        const Real value = bound(*term, part.group, begin, end);
        std::lock_guard lock(mutex);
        largest = value > largest || std::isnan(value) ? value : largest;
      });
      of_part += largest;
    }
    of_all = of_part > of_all || std::isnan(of_part) ? of_part : of_all;
  }
  return of_all;
}

template <class Real>
Real ElasticBody<Real>::frequency_bound(const Real* x, ThreadTeam& team) {
  Real bound = max_bound(team, [x](const auto& term, const auto& group, std::size_t begin, std::size_t end) {
    return term.frequency_bound(group, x, begin, end);
  });
  if (pressure_) bound += pressure_->frequency_bound(x, team);
  if (!springs_.empty()) bound += springs_.frequency_bound(masses());
  return bound;
}

template <class Real>
Real ElasticBody<Real>::damping_bound(const Real* x, ThreadTeam& team) {
  if (!has_internal_state()) return 0;
  return max_bound(team, [x](const auto& term, const auto& group, std::size_t begin, std::size_t end) {
    return term.damping_bound(group, x, begin, end);
  });
}

template <class Real>
std::vector<Real> ElasticBody<Real>::element_bounds(const Real* x) const {
  std::vector<Real> bounds(mesh_.tets.size(), Real(0));
  each_slot(
      x, [&](const Part& part, std::size_t s, const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest) {
        for (const auto& term : part.terms)
          bounds[static_cast<std::size_t>(part.group.element[s])] +=
              term->slot_frequency_bound(part.group, s, kinematics, rest);
      });
  return bounds;
}

template <class Real>
std::size_t ElasticBody<Real>::bytes() const {
  std::size_t sum = bytes_of(mesh_.nodes, mesh_.tets, mesh_.regions, material_of_);
  for (const ElementField& field : mesh_.fields) sum += bytes_of(field.values);
  sum += bytes_of(corners_.start, corners_.corners, force_corners_.start, force_corners_.corners, corner_,
                  linearisation_point_, packet_energy_);
  for (const Part& part : parts_) {
    const ElementGroup<Real>& group = part.group;
    sum += bytes_of(group.element, group.node, group.A, group.volume, group.gamma, group.fibre, group.parameters);
    sum += bytes_of(part.stiffness) + (part.flow ? part.flow->bytes() : 0);
    for (const auto& term : part.terms)
      for (const SlotState<Real>& state : term->slot_states()) sum += bytes_of(*state.values);
  }
  return sum + fans_.bytes() + springs_.bytes() + (pressure_ ? pressure_->bytes() : 0);
}

template <class Real>
int ElasticBody<Real>::first_undefined(const Real* x) const {
  int first = -1;
  each_slot(
      x, [&](const Part& part, std::size_t s, const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest) {
        for (const auto& term : part.terms)
          if (first < 0 || part.group.element[s] < first)
            if (!term->valid(part.group, s, kinematics) || !is_finite(term->tensions(part.group, s, kinematics, rest)))
              first = part.group.element[s];
      });
  return first;
}

template <class Real>
void ElasticBody<Real>::states(const Real* x, std::vector<ElementState<Real>>& out) const {
  out.resize(mesh_.tets.size());
  each_slot(
      x, [&](const Part& part, std::size_t s, const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest) {
        StressSum<Real> stress;
        for (const auto& term : part.terms) stress.add(term->tensions(part.group, s, kinematics, rest), rest);
        Real factor[3][3], C[6];
        cholesky3(rest.A, factor);
        into_rest_frame(factor, kinematics.G, C);
        out[static_cast<std::size_t>(part.group.element[s])] = state_of(stress, C, kinematics.at.J);
      });
}

template <class Real>
std::vector<Mat3> ElasticBody<Real>::stresses(const Real* x, ThreadTeam& team) {
  std::fill(corner_.begin(), corner_.end(), Real(0));
  for (const Part& part : parts_)
    for (const auto& term : part.terms)
      if (term->stores())
        team.parallel_for(part.group.packets(), grain_ / part.group.lanes, [&](std::size_t begin, std::size_t end) {
          term->forces(part.group, x, begin, end, corner_.data(), true);
        });
  if (pressure_) pressure_->add_forces(x, corner_.data(), team);
  std::vector<Mat3> P(mesh_.tets.size(), Mat3::Zero());
  for (const Part& part : parts_)
    for (std::size_t s = 0; s < part.group.size(); ++s) {
      const auto t = static_cast<std::size_t>(part.group.element[s]);
      const auto X = [&](std::size_t a) { return mesh_.nodes[static_cast<std::size_t>(part.group.node[a][s])]; };
      const double volume = signed_volume(X(0), X(1), X(2), X(3));
      for (std::size_t a = 1; a < 4; ++a) {
        const Real* f = &corner_[3 * (part.group.first_corner + 4 * s + a)];
        P[t] -= Vec3(f[0], f[1], f[2]) * (X(a) - X(0)).transpose() / volume;
      }
    }
  return P;
}

template <class Real>
void ElasticBody<Real>::set_material(std::size_t index, const Material& material, const Real* x) {
  materials_[index] = material;
  make_parts();
  if (!fans_.update_laws(fan_parts(), options_.continuation)) make_fans();
  reset_history(x);
}

template <class Real>
SlotStates<Real> ElasticBody<Real>::Part::slot_states() {
  SlotStates<Real> lists = flow ? flow->slot_states(group) : SlotStates<Real>();
  for (const auto& term : terms)
    for (const SlotState<Real>& list : term->slot_states()) lists.push_back(list);
  return lists;
}

template <class Real>
bool ElasticBody<Real>::has_internal_state() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [&](const Part& part) { return materials_[part.material].has_internal_state(); });
}

template <class Real>
void ElasticBody<Real>::begin_step(Real h) {
  step_ = h;
  for (Part& part : parts_)
    for (const auto& term : part.terms) term->begin_step(h);
}

template <class Real>
void ElasticBody<Real>::commit(const Real* x) {
  for (Part& part : parts_) {
    for (const auto& term : part.terms) term->commit(part.group, x);
    if (part.flow) plastic_work_ += part.flow->flow(part.group, x);
  }
}

template <class Real>
void ElasticBody<Real>::reset_history(const Real* x) {
  plastic_work_ = 0;
  for (Part& part : parts_) {
    if (part.flow) part.flow->reset(part.group);
    for (const auto& term : part.terms) term->reset_history(part.group, x);
  }
}

template <class Real>
std::vector<Real> ElasticBody<Real>::masses() const {
  std::vector<double> mass(nodes(), 0.0);
  for (const Part& part : parts_)
    for (std::size_t s = 0; s < part.group.size(); ++s)
      for (const auto& list : part.group.node)
        mass[static_cast<std::size_t>(list[s])] +=
            static_cast<double>(part.group.density) * static_cast<double>(part.group.volume[s]) / 4;
  return {mass.begin(), mass.end()};
}

template class ElasticBody<float>;
template class ElasticBody<double>;

}  // namespace heml
