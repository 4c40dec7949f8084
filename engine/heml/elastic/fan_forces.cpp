#include <atomic>
#include <heml/elastic/fan_energy.hpp>
#include <heml/elastic/fan_forces.hpp>
#include <heml/materials/laws.hpp>
#include <heml/math/bytes.hpp>

namespace heml {
namespace {

FanElements elements_of(const TetMesh& mesh, const FanPart& part, FanShape shape) {
  FanElements result{*part.elements, shape, {}};
  if (shape != FanShape::fibre) return result;
  const std::string& field = part.material->fibre_field;
  const std::vector<double>* values = field.empty() ? nullptr : &find_field(mesh, field)->values;
  result.fibre = [values, fibre = part.material->fibre](int t) -> Vec3 {
    return values ? Eigen::Map<const Vec3>(&(*values)[3 * static_cast<std::size_t>(t)]).normalized() : fibre;
  };
  return result;
}

}  // namespace

template <class Real>
FanForces<Real>::FanForces(const TetMesh& mesh, const std::vector<FanPart>& parts, bool continuation,
                           InstructionSet isa, ThreadTeam& team)
    : isa_(resolve(isa)) {
  std::vector<FanElements> elements;
  for (const FanPart& part : parts) {
    laws_.push_back(law_of(part, continuation));
    elements.push_back(elements_of(mesh, part, laws_.back().shape));
  }
  layout_ = std::make_shared<const FanLayout<Real>>(mesh, elements, lanes_of<Real>(isa_), team);
  shared_force_.resize(3 * layout_->shared_slots);
}

template <class Real>
typename FanForces<Real>::Law FanForces<Real>::law_of(const FanPart& part, bool continuation) const {
  const Material& material = *part.material;
  Law result;
  if (find_energy_law(material.law))
    with_invariant_energy<Real>(material, [&]<class L>(const L& law) {
      result.kernel = energy_fan_kernel<Real>(isa_, L::uses_I4);
      result.law = std::make_shared<const L>(law);
      result.shape = L::uses_I4 ? FanShape::fibre : FanShape::plain;
    });
  else
    with_law<Real>(material, continuation, [&]<class L>(L law) {
      if constexpr (L::has_volume_term)
        if (part.isochoric) law.kappa = 0;
      result.kernel = fan_kernel<Real>(isa_, law_index(L::name), continuation);
      result.law = std::make_shared<const L>(law);
      result.shape = PrincipalLaw<L, Real> ? FanShape::principal : L::uses_I4 ? FanShape::fibre : FanShape::plain;
    });
  const bool has_fibre = result.shape == FanShape::fibre;
  result.fibre = has_fibre && material.fibre_field.empty() ? material.fibre : Vec3::Zero();
  if (has_fibre) result.fibre_field = material.fibre_field;
  return result;
}

template <class Real>
bool FanForces<Real>::update_laws(const std::vector<FanPart>& parts, bool continuation) {
  if (parts.size() != laws_.size()) return false;
  std::vector<Law> laws;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    laws.push_back(law_of(parts[p], continuation));
    const Law &now = laws.back(), &before = laws_[p];
    if (now.shape != before.shape || now.fibre != before.fibre || now.fibre_field != before.fibre_field) return false;
  }
  laws_ = std::move(laws);
  return true;
}

template <class Real>
bool FanForces<Real>::update_layout(const TetMesh& before, const TetMesh& mesh, const std::vector<FanPart>& parts,
                                    const std::vector<int>& origins, ThreadTeam& team) {
  if (parts.size() != laws_.size()) return false;
  std::vector<FanElements> elements;
  for (std::size_t p = 0; p < parts.size(); ++p) elements.push_back(elements_of(mesh, parts[p], laws_[p].shape));
  layout_ = std::make_shared<const FanLayout<Real>>(
      layout_->after_edit(before, mesh, elements, origins, lanes_of<Real>(isa_), team));
  shared_force_.assign(3 * layout_->shared_slots, Real(0));
  return true;
}

template <class Real>
bool FanForces<Real>::forces(const Real* x, Real* f, ThreadTeam& team) {
  const FanLayout<Real>& fans = *layout_;
  std::atomic<bool> valid{true};
  const std::size_t blocks_a_thread = 1 + grain_ * fans.blocks.size() / (fans.elements() + 1);
  team.parallel_for(fans.blocks.size(), blocks_a_thread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const auto& at = fans.blocks[b];
      const Law& law = laws_[at.part];
      const FanBlock<Real> block{&fans.size[at.group],
                                 at.groups,
                                 &fans.index[at.index],
                                 &fans.shape[at.shape],
                                 &fans.place[at.place],
                                 at.own,
                                 at.nodes,
                                 shared_force_.data() + 3 * at.shared_slot};
      if (!law.kernel(law.law.get(), block, x, f)) valid.store(false, std::memory_order_relaxed);
    }
  });
  team.parallel_for(fans.shared_node.size(), grain_ / 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Real sum[3] = {0, 0, 0};
      for (std::size_t s = fans.shared_start[k]; s < fans.shared_start[k + 1]; ++s)
        for (std::size_t i = 0; i < 3; ++i) sum[i] += shared_force_[3 * fans.shared_slot[s] + i];
      Real* to = f + 3 * fans.shared_node[k];
      for (std::size_t i = 0; i < 3; ++i) to[i] = sum[i];
    }
  });
  return valid;
}

template <class Real>
std::size_t FanForces<Real>::bytes() const {
  const FanLayout<Real>& fans = *layout_;
  return bytes_of(fans.blocks, fans.size, fans.index, fans.shape, fans.place, fans.element, fans.shared_node,
                  fans.shared_start, fans.shared_slot, shared_force_);
}

template class FanForces<float>;
template class FanForces<double>;

}  // namespace heml
