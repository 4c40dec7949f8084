#pragma once
// The whole state of a world at one moment, to which World::restore() returns: restored, a world goes on to the same bits
// as if it had never left that state. Immutable: any thread may keep and share it, and it may outlive its world.
#include <cstddef>

namespace heml {

class WorldSnapshot {
 public:
  virtual ~WorldSnapshot() = default;

  virtual long ticks() const = 0;   ///< World::ticks() then
  virtual double time() const = 0;  ///< s, World::time() then
  /// Size in bytes. What snapshots share, the mesh and its layout between edits, counts in each of them.
  virtual std::size_t bytes() const = 0;
};

}  // namespace heml
