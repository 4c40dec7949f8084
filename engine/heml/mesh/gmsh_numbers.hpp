#pragma once
// Numbers of an .msh file, as text or binary: the same calls read both.
#include <heml/mesh/binary_values.hpp>
#include <heml/mesh/scanner.hpp>

namespace heml {

class GmshNumbers {
 public:
  explicit GmshNumbers(Scanner& in) : in_(in) {}

  /// From here on, what line() begins is binary: after a file's format line.
  void set_binary(std::endian order, std::size_t size_bytes) {
    binary_ = true;
    order_ = order;
    size_bytes_ = size_bytes;
    in_.tell_bytes();
  }
  bool binary() const { return binary_; }

  /// Text: the next line. Binary: numbers follow without lines.
  void line(std::string_view what) {
    if (!binary_) in_.expect_line(what);
  }
  void end_line(std::string_view of) {
    if (!binary_) in_.end_line(of);
  }
  /// Binary: moves behind the line that is read, where numbers begin.
  void begin_binary() {
    if (binary_) in_.rest_of_line();
  }

  long long integer(std::string_view what, int low = std::numeric_limits<int>::min()) {  ///< C's int
    if (!binary_) return in_.integer(what, low);
    const long long value = integer_value(in_.bytes(sizeof(int)), NumberKind::signed_integer, order_);
    if (value < low) in_.fail(std::string(what) + " is " + std::to_string(value));
    return value;
  }
  /// C's size_t in version 4.1 (`size` true), int before.
  long long wide_integer(std::string_view what, bool size = true) {
    if (!binary_) return in_.wide_integer(what);
    return integer_value(in_.bytes(size ? size_bytes_ : sizeof(int)), NumberKind::signed_integer, order_);
  }
  double any_number(std::string_view what) {
    return binary_ ? real_value(in_.bytes(sizeof(double)), order_) : in_.any_number(what);
  }
  Vec3 point(std::string_view what) {
    if (!binary_) return in_.point(what);
    const double x = any_number(what), y = any_number(what), z = any_number(what);
    const Vec3 point(x, y, z);
    if (!point.allFinite()) in_.fail(std::string(what) + " is not finite");
    return point;
  }
  /// Number of items that follow, each of so many numbers in text or bytes in binary. Throws if the rest of the file
  /// cannot hold them, so that memory can be taken.
  std::size_t count(std::string_view what, std::size_t values, std::size_t bytes) {
    if (!binary_) return in_.count(what, values);
    const long long count = wide_integer(what);
    if (count < 0 || static_cast<std::size_t>(count) > in_.left() / bytes)
      in_.fail(std::string(what) + " is " + std::to_string(count) + ", more than the " + std::to_string(in_.left()) +
                   " bytes left in the file can hold",
               "the file is cut off or damaged, save it again");
    return static_cast<std::size_t>(count);
  }
  /// Binary: passes over so many bytes.
  void skip(std::size_t items, std::size_t bytes) {
    if (items > in_.left() / bytes) in_.fail("the file ends too early", "it is cut off, save it again");
    in_.bytes(items * bytes);
  }
  std::size_t size_bytes() const { return size_bytes_; }

 private:
  Scanner& in_;
  bool binary_ = false;
  std::endian order_ = std::endian::little;
  std::size_t size_bytes_ = 8;
};

}  // namespace heml
