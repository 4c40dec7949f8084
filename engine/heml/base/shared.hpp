#pragma once
// A value that its copies share until one of them changes it (copy on write):
//
//   Shared<TetMesh> a(mesh), b = a;     a ──► mesh ◄── b        nothing is copied
//   b.write().nodes.push_back(x);       a ──► mesh,  b ──► a mesh of its own
//   b.write().tets.push_back(t);                     b alone has it: nothing is copied
//
// Worlds, their snapshots and their undo history share so what steps do not change.
#include <memory>
#include <utility>

namespace heml {

/// Different threads may read, copy, write and destroy different Shared of one value at a time; a Shared itself is no
/// safer than any value.
template <class T>
class Shared {
 public:
  Shared() : Shared(T()) {}
  Shared(T value) : value_(std::make_shared<T>(std::move(value))) {}  // NOLINT: stands for the value

  const T& operator*() const { return *value_; }
  const T* operator->() const { return value_.get(); }
  /// The value to be changed; a copy first, where others share it. References from before may be of the old one.
  T& write() {
    if (value_.use_count() > 1) value_ = std::make_shared<T>(*value_);
    // A copy that goes at once: its count is changed after that of who shared the value last, and so after their reads.
    std::shared_ptr<T>(value_).reset();
    return *value_;
  }
  /// Whether both are one value in memory.
  bool shares_with(const Shared& other) const { return value_ == other.value_; }

 private:
  std::shared_ptr<T> value_;
};

}  // namespace heml
