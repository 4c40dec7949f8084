#pragma once
// NumPy arrays as memory: made, or taken from the caller and checked.
#include <nanobind/nanobind.h>

#include <functional>
#include <string>
#include <vector>

namespace heml::python {

using Shape = std::vector<Py_ssize_t>;

/// Types of the elements of an array.
enum class ElementType { float64, int32, uint8 };

/// A new array, not initialised.
nanobind::object make_array(const Shape& shape, ElementType type = ElementType::float64);

/// The memory of an array in C order, as long as this lives.
class ArrayMemory {
 public:
  enum class Access { read, write };
  /// Throws InputError naming `name` where the array is of another type or shape (−1: any extent), not in C order, or
  /// read-only where it is to be written.
  ArrayMemory(nanobind::handle array, const std::string& name, const Shape& shape, Access access,
              ElementType type = ElementType::float64);
  ~ArrayMemory();
  ArrayMemory(const ArrayMemory&) = delete;
  ArrayMemory& operator=(const ArrayMemory&) = delete;

  template <class T>
  T* data() const {
    return static_cast<T*>(view_.buf);
  }
  Py_ssize_t extent(int axis) const { return view_.shape[axis]; }

 private:
  Py_buffer view_{};
};

/// Fills `out`, or a new array where it is None, and returns it.
nanobind::object filled(nanobind::object out, const Shape& shape, const std::function<void(double*)>& fill);

/// Numbers given as an array, which must be right as it is, or as nested lists, which become one. Throws InputError
/// also where one is not finite.
nanobind::object input_array(nanobind::object given, const std::string& name, const Shape& shape);

}  // namespace heml::python
