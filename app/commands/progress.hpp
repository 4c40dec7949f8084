#pragma once
// Progress on one line of a terminal, overwritten: "heml: capturing 20 %, 40 s left". Prints nothing when stderr is
// not a terminal.
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace heml {

class Progress {
 public:
  /// what: "capturing frames".
  explicit Progress(std::string what);
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// fraction: 0 to 1, of the work since the constructor, from which the time left is estimated. doing: the current
  /// part, printed after it. Prints at most ten times per second. In a part that takes long the line goes on once a
  /// second, with the time since the constructor.
  void show(double fraction, const std::string& doing = "");
  /// Prints a line of results to stdout at once, above the line of progress.
  void print_result(const std::string& line);

 private:
  void print(double now);
  void clear();
  void go_on(const std::stop_token& stop);

  std::string what_;
  bool terminal_;
  double begin_;      ///< s
  double last_ = -1;  ///< s, when it last printed
  bool printed_ = false;
  double fraction_ = 0;
  std::string doing_;
  std::mutex mutex_;  ///< of all that changes
  std::condition_variable_any wake_;
  std::jthread thread_;  ///< declared last: joined before the members it uses are destroyed
};

}  // namespace heml
