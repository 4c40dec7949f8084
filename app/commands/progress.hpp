#pragma once
// Progress on one line of a terminal, overwritten: "heml: capturing 20 %, 40 s left". Prints nothing when stderr is
// not a terminal.
#include <string>

namespace heml {

class Progress {
 public:
  /// what: "capturing frames".
  explicit Progress(std::string what);
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// fraction: 0 to 1, of the work since the constructor, from which the time left is estimated. doing: the current
  /// part, printed after it. Prints at most ten times per second.
  void show(double fraction, const std::string& doing = "");

 private:
  std::string what_;
  bool terminal_;
  double begin_;      ///< s
  double last_ = -1;  ///< s, when it last printed
  bool printed_ = false;
};

}  // namespace heml
