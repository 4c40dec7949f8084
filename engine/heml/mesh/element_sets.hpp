#pragma once
// Named sets of elements by their numbers in a file, and the regions that they make.
#include <heml/mesh/readers.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

/// Numbers first, first + step, ... up to last.
struct NumberRange {
  long long first, last, step = 1;
};

class ElementSets {
 public:
  /// The set of that name, in capitals or not; made where there is none. Throws (Scanner::fail of `in`) beyond 10,000.
  std::size_t find_or_add(std::string_view name, const Scanner& in);
  void add(std::size_t set, const NumberRange& range);
  /// Adds what another set holds. Throws (Scanner::fail of `in`) unless that set was made before this one.
  void add_set(std::size_t set, std::string_view other, const Scanner& in);
  /// Regions are of such sets alone, where there are any: those to which the file gives a material.
  void choose(std::string_view name) { chosen_.push_back(std::string(name)); }

  /// Numbers and names the regions of the mesh: 1, 2, ... by the order of the sets. A tetrahedron in several sets
  /// belongs to the smallest, one in none to region 0. numbers: of the file, of each tetrahedron. Throws (Scanner::fail
  /// of `in`) where sets within sets name far more elements than the file has bytes.
  void put(const std::vector<long long>& numbers, const Scanner& in, TetMesh& mesh) const;

 private:
  struct Set {
    std::string name;
    std::vector<NumberRange> ranges;
    std::vector<std::size_t> others;
  };
  std::vector<Set> sets_;
  std::map<std::string, std::size_t> index_;  ///< by the name in capitals
  std::vector<std::string> chosen_;
};

}  // namespace heml
