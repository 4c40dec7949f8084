#include <cmath>
#include <heml/materials/continuum.hpp>
#include <heml/materials/laws.hpp>
#include <heml/materials/point.hpp>
#include <heml/materials/stretch_energy.hpp>
#include <vector>

namespace heml {
namespace {

template <class L>
class PointOf final : public MaterialPoint {
 public:
  PointOf(const L& law, const Vec3& fibre) : law_(law), fibre_(fibre) {}

  bool valid(const Mat3& F) const override {
    const auto at = strain_measures<double>(F, fibre_);
    return law_.valid(at.invariants()) && std::isfinite(energy_density(law_, at)) && first_piola(F).allFinite() &&
           first_piola_differential(F, F).allFinite();
  }
  double energy(const Mat3& F) const override { return energy_density(law_, strain_measures<double>(F, fibre_)); }
  Mat3 first_piola(const Mat3& F) const override {
    return heml::first_piola<double>(stress_of(law_, strain_measures<double>(F, fibre_)), F);
  }
  Mat3 first_piola_differential(const Mat3& F, const Mat3& dF) const override {
    const auto at = strain_measures<double>(F, fibre_);
    double dC[6];
    to_symmetric6<double>(dF.transpose() * F + F.transpose() * dF, dC);
    const double dJ = cofactor(F).cwiseProduct(dF).sum();
    return first_piola_change<double>(stress_of(law_, at), stress_differential(law_, at, dC, dJ), F, dF);
  }

 private:
  L law_;
  Vec3 fibre_;
};

class PointSum final : public MaterialPoint {
 public:
  explicit PointSum(std::vector<std::unique_ptr<MaterialPoint>> terms) : terms_(std::move(terms)) {}

  bool valid(const Mat3& F) const override {
    for (const auto& term : terms_)
      if (!term->valid(F)) return false;
    return true;
  }
  double energy(const Mat3& F) const override {
    double sum = 0;
    for (const auto& term : terms_) sum += term->energy(F);
    return sum;
  }
  Mat3 first_piola(const Mat3& F) const override {
    Mat3 sum = Mat3::Zero();
    for (const auto& term : terms_) sum += term->first_piola(F);
    return sum;
  }
  Mat3 first_piola_differential(const Mat3& F, const Mat3& dF) const override {
    Mat3 sum = Mat3::Zero();
    for (const auto& term : terms_) sum += term->first_piola_differential(F, dF);
    return sum;
  }

 private:
  std::vector<std::unique_ptr<MaterialPoint>> terms_;
};

template <bool continued>
std::unique_ptr<MaterialPoint> volume_point(VolumeTerm term, double kappa) {
  if (term == VolumeTerm::simo_taylor)
    return std::make_unique<PointOf<VolumeLaw<double, continued, true>>>(VolumeLaw<double, continued, true>{kappa},
                                                                         Vec3::Zero());
  return std::make_unique<PointOf<VolumeLaw<double, continued, false>>>(VolumeLaw<double, continued, false>{kappa},
                                                                        Vec3::Zero());
}

}  // namespace

std::unique_ptr<MaterialPoint> make_material_point(const Material& material, bool continuation) {
  std::unique_ptr<MaterialPoint> point;
  if (find_energy_law(material.law)) {
    with_energy<double>(material,
                        [&]<class L>(const L& law) { point = std::make_unique<PointOf<L>>(law, material.fibre); });
    return point;
  }
  double kappa = 0;
  const bool own_volume_term = material.volume_term == VolumeTerm::quadratic;
  with_law<double>(material, continuation, [&]<class L>(L law) {
    if constexpr (L::has_volume_term)
      if (!own_volume_term) kappa = std::exchange(law.kappa, 0);
    point = std::make_unique<PointOf<L>>(law, material.fibre);
  });
  if (own_volume_term) return point;
  std::vector<std::unique_ptr<MaterialPoint>> terms;
  terms.push_back(std::move(point));
  terms.push_back(continuation ? volume_point<true>(material.volume_term, kappa)
                               : volume_point<false>(material.volume_term, kappa));
  return std::make_unique<PointSum>(std::move(terms));
}

}  // namespace heml
