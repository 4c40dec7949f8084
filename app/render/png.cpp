#include "app/render/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <cstdio>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <memory>
#include <stdexcept>
#include <string>

namespace heml::render {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// Error callbacks of libpng. Throwing through it is safe because Debian builds it with unwind tables; unlike longjmp,
// it runs destructors.
[[noreturn]] void throw_error(png_structp, png_const_charp message) { throw std::runtime_error(message); }
void ignore_warning(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

class Writer {
 public:
  Writer() : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, throw_error, ignore_warning)) {
    info = png_create_info_struct(png);
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  png_structp png;
  png_infop info;
};

class Reader {
 public:
  Reader() : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, throw_error, ignore_warning)) {
    info = png_create_info_struct(png);
  }
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  png_structp png;
  png_infop info;
};

Image decode(std::FILE* file) {
  Reader reader;
  png_init_io(reader.png, file);
  png_set_user_limits(reader.png, 16384, 16384);
  png_read_info(reader.png, reader.info);
  png_set_expand(reader.png);
  png_set_strip_16(reader.png);
  png_set_strip_alpha(reader.png);
  png_set_gray_to_rgb(reader.png);
  const int passes = png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  Image image({static_cast<int>(png_get_image_width(reader.png, reader.info)),
               static_cast<int>(png_get_image_height(reader.png, reader.info))});
  if (png_get_rowbytes(reader.png, reader.info) != std::size_t{3} * image.size.width)
    throw std::runtime_error("a pixel format that does not become RGB");
  for (int pass = 0; pass < passes; ++pass)
    for (int y = 0; y < image.size.height; ++y) png_read_row(reader.png, image.at(0, y), nullptr);
  png_read_end(reader.png, nullptr);
  return image;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image) {
  std::string bytes;
  try {
    Writer writer;
    png_set_write_fn(writer.png, &bytes, append, nullptr);
    png_set_IHDR(writer.png, writer.info, image.size.width, image.size.height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(writer.png, 1);
    png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_write_info(writer.png, writer.info);
    for (int y = 0; y < image.size.height; ++y) png_write_row(writer.png, image.at(0, y));
    png_write_end(writer.png, nullptr);
  } catch (const std::runtime_error& error) {
    throw InputError(path.string(), "", fmt::format("cannot be written as PNG: {}", error.what()), "");
  }
  write_file(path, bytes);
}

Image read_png(const std::filesystem::path& path) {
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw InputError(path.string(), "", "cannot be opened", "name an existing PNG file");
  try {
    return decode(file.get());
  } catch (const std::runtime_error& error) {
    throw InputError(path.string(), "", fmt::format("not a sound PNG: {}", error.what()), "");
  }
}

}  // namespace heml::render
