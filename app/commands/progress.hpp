#pragma once
// "heml: capturing 20 %, 40 s left" on one line of a terminal that is overwritten; nothing where stderr is a file.
#include <string>

namespace heml {

class Progress {
 public:
  /// what: "capturing frames".
  explicit Progress(std::string what);
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// fraction: 0 to 1, of the work that began with this object; what is left is estimated from it. doing: what just
  /// now, behind it. Prints ten times a second at most.
  void show(double fraction, const std::string& doing = "");

 private:
  std::string what_;
  bool terminal_;
  double begin_;      ///< s
  double last_ = -1;  ///< s, when it last printed
  bool printed_ = false;
};

}  // namespace heml
