#pragma once
// What an import finds in a FEBio file that it does not compute as FEBio does, and the parts that it is told by.
#include <heml/mesh/xml.hpp>
#include <string>
#include <vector>

namespace heml {

class FebFindings {
 public:
  /// What would change the result: the import ends in throw_refused(). Each text counts once.
  void refuse(const XmlElement& at, const std::string& text);
  /// What does not, or only as told.
  void note(const XmlElement& at, const std::string& text);
  /// Throws one InputError that names all that was refused, if anything was.
  void throw_refused(const std::string& file) const;
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::vector<std::string> refused_, notes_;
};

/// "<bc>"
std::string feb_tag(const XmlElement& element);
/// "<bc> 'name' of type TYPE": how messages call an element.
std::string feb_name(const XmlElement& element);

/// A FEBio file's units of length and force, in metres and newtons; time is in seconds.
struct FebUnits {
  std::string name = "SI";
  double length = 1, force = 1;
  double stress() const { return force / (length * length); }
  double density() const { return force / (length * length * length * length); }
};

}  // namespace heml
