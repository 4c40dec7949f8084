#pragma once
// The contact surfaces of a world and a report for each: force, work, penetration. Explicit methods resolve contact by
// impulses (contact_impulses.hpp), implicit ones by an energy (contact_potential.hpp); both fill the reports.
#include <heml/tools/contact_surface.hpp>
#include <heml/tools/self_contact.hpp>
#include <optional>
#include <vector>

namespace heml {

/// Effect of one surface on the body.
struct ContactReport {
  Vec3 force = Vec3::Zero();   ///< N, on the body: of the last implicit step, or the mean over the steps of a tick
  double normal_force = 0;     ///< N, self-contact only, whose forces sum to zero: sum of the magnitudes
  double work = 0;             ///< J, on the body: negative of friction, possibly positive of a probe, zero of impacts
  double energy = 0;           ///< J, stored in the contact energy of an implicit method
  double max_penetration = 0;  ///< m, 0: none
  int contact_count = 0;       ///< points in contact: in the last implicit step, or at most in the steps of a tick
  int rounds = 0;              ///< self-contact, explicit methods: rounds over all pairs in the last step
  double residual = 0;         ///< and the change of an impulse in the last round, of the largest impulse
};

struct Contacts {
  std::vector<PlacedTable> tables;
  std::optional<Probe> probe;
  std::vector<Suture> sutures;
  std::optional<SelfContact> tissue;   ///< self-contact, where a scene asks for it; rebuilt when the mesh is edited
  ContactBoundary boundary;            ///< internal numbers; rebuilt when the mesh is edited, while there is a surface
  std::vector<ContactReport> reports;  ///< of the tables, the probe, the sutures, the tissue

  /// Report of surfaces()[s]; zero before the first step.
  ContactReport report_of(std::size_t s) const { return s < reports.size() ? reports[s] : ContactReport(); }

  bool empty() const { return !has_tools() && !tissue; }
  /// Whether there is any table, probe or suture.
  bool has_tools() const { return !tables.empty() || probe || !sutures.empty(); }
  /// Tables, the probe, sutures and the tissue itself, in this order, at a time (s).
  std::vector<ContactSurface> surfaces(double time) const {
    std::vector<ContactSurface> all;
    for (const PlacedTable& table : tables) all.push_back(surface_of(table, time));
    if (probe) all.push_back(surface_of(*probe, time));
    for (const Suture& suture : sutures) all.push_back(surface_of(suture, time));
    if (tissue) all.push_back({ContactSurface::Shape::tissue, Vec3::Zero(), Vec3::Zero(), 0, tissue->friction()});
    return all;
  }
};

}  // namespace heml
