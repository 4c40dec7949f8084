#pragma once
// A chart as a PNG, drawn without a display.
#include <app/panel/bar_chart.hpp>
#include <app/panel/chart.hpp>
#include <app/render/image.hpp>
#include <filesystem>

namespace heml {

/// Throws InputError when the file cannot be written, std::runtime_error when there is no software OpenGL.
void write_chart(const std::filesystem::path& path, const panel::Chart& chart, render::Size size = {1280, 800});
void write_chart(const std::filesystem::path& path, const panel::BarChart& chart, render::Size size = {1280, 800});

}  // namespace heml
