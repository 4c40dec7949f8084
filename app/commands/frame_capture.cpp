#include <fmt/format.h>

#include <app/commands/frame_capture.hpp>
#include <app/render/png.hpp>
#include <heml/base/write_file.hpp>

namespace heml {

FrameCapture::FrameCapture(const Scene& scene, const World& world, ImageSize size, bool panel, bool comparisons,
                           std::filesystem::path folder)
    : folder_(std::move(folder)), drawing_(scene, world, {size.width, size.height}, panel, comparisons) {
  make_folder(folder_);
}

void FrameCapture::capture(World& world, double ahead, double seconds, ComparisonRuns* comparison_runs) {
  render::write_png(folder_ / fmt::format("frame_{:05}.png", taken_),
                    drawing_.draw(world, ahead, seconds, comparison_runs));
  ++taken_;
}

}  // namespace heml
