#pragma once
// Collects warnings, which go to stderr all the same, for a window to show.
#include <string>
#include <vector>

namespace heml {

/// Of the thread that makes it, while it lives. May be nested: the outer one gets the inner one's warnings too.
class WarningCollector {
 public:
  WarningCollector();
  ~WarningCollector();
  WarningCollector(const WarningCollector&) = delete;
  WarningCollector& operator=(const WarningCollector&) = delete;

  const std::vector<std::string>& texts() const { return texts_; }
  /// Adds to the collectors of the calling thread.
  static void add(const std::string& text);

 private:
  WarningCollector* outer_;
  std::vector<std::string> texts_;
};

}  // namespace heml
