#pragma once
// All that tissue of a world may not pass, and what they have done to its body: a force, the work of it, how deep
// tissue is in one. Explicit methods are stopped by impulses (contact_impulses.hpp), implicit ones by an energy
// (contact_potential.hpp); both tell here.
#include <heml/tools/contact_surface.hpp>
#include <heml/tools/self_contact.hpp>
#include <optional>
#include <vector>

namespace heml {

/// What a surface has done to the body.
struct ContactReport {
  Vec3 force = Vec3::Zero();  ///< N, on the body: of the last step, or the mean of the steps of a tick
  double normal_force = 0;    ///< N, likewise, of tissue on tissue, whose forces have no sum: the sum of what presses
  double work = 0;    ///< J, force times way: friction's is negative, a probe's may be positive; impacts have none
  double energy = 0;  ///< J, that is stored in an implicit method's contact
  double max_penetration = 0;  ///< m, that a point of the body is inside; 0: none
  int contact_count = 0;       ///< points of the body
};

struct Contacts {
  std::vector<Table> tables;
  std::optional<Probe> probe;
  std::vector<Suture> sutures;
  std::optional<SelfContact> tissue;   ///< kept up with the body, where a scene asks for it
  ContactBoundary boundary;            ///< inner numbers; kept up with the body while there is a surface
  std::vector<ContactReport> reports;  ///< of the tables, the probe, the sutures, the tissue

  /// Of one of surfaces(), by number; before the first step nothing.
  ContactReport report_of(std::size_t s) const { return s < reports.size() ? reports[s] : ContactReport(); }

  bool empty() const { return !has_tools() && !tissue; }
  /// Whether there is more than the tissue itself.
  bool has_tools() const { return !tables.empty() || probe || !sutures.empty(); }
  /// Tables, the probe, sutures, the tissue itself, at a time, s.
  std::vector<ContactSurface> surfaces(double time) const {
    std::vector<ContactSurface> all;
    for (const Table& table : tables) all.push_back(surface_of(table));
    if (probe) all.push_back(surface_of(*probe, time));
    for (const Suture& suture : sutures) all.push_back(surface_of(suture, time));
    if (tissue) all.push_back({ContactSurface::Shape::tissue, Vec3::Zero(), Vec3::Zero(), 0, tissue->friction()});
    return all;
  }
};

}  // namespace heml
