#pragma once
#include <string>
#include <utility>

namespace heml {

/// Success, or one sentence that says what is wrong and what to do: the result of an action that may be refused.
/// `if (const Status done = world.apply(command); !done.ok()) warn("{}", done.message());`
class Status {
 public:
  Status() = default;  ///< success
  Status(std::string message) : message_(std::move(message)), ok_(false) {}
  Status(const char* message) : Status(std::string(message)) {}

  bool ok() const { return ok_; }
  const std::string& message() const { return message_; }  ///< empty on success
  friend bool operator==(const Status&, const Status&) = default;

 private:
  std::string message_;
  bool ok_ = true;
};

}  // namespace heml
