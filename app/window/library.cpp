#include <fmt/format.h>

#include <algorithm>
#include <app/render/png.hpp>
#include <app/window/glfw_window.hpp>
#include <app/window/library.hpp>
#include <app/window/state_folder.hpp>
#include <heml/base/error.hpp>
#include <heml/scenario/file_kind.hpp>
#include <heml/scenario/scene.hpp>

namespace heml::window {
namespace {

namespace fs = std::filesystem;
using panel::OpenChoice;
constexpr std::size_t max_listed = 2000;

std::string size_text(std::uintmax_t bytes) {
  const double size = static_cast<double>(bytes);
  return size < 1e6 ? fmt::format("{:.0f} kB", std::max(1.0, size / 1e3)) : fmt::format("{:.1f} MB", size / 1e6);
}

const char* name_of(FileKind kind) {
  switch (kind) {
    case FileKind::scene:
      return "scene";
    case FileKind::recording:
      return "recording";
    case FileKind::tetrahedra:
      return "tetrahedra";
    case FileKind::surface:
      return "surface";
    case FileKind::labels:
      return "label map";
    case FileKind::other:
      break;
  }
  return "file";
}

/// The readable scenes of a folder, sorted by file name.
std::vector<OpenChoice> scenes_in(const fs::path& folder) {
  std::vector<OpenChoice> choices;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    if (kind_of(entry->path()) != FileKind::scene) continue;
    try {
      const Scene scene = read_scene(entry->path());
      choices.push_back({entry->path(), scene.title.empty() ? scene.name : scene.title, scene.description});
    } catch (const InputError&) {  // unreadable, e.g. of another version: omitted
    }
  }
  std::sort(choices.begin(), choices.end(), [](const OpenChoice& a, const OpenChoice& b) { return a.path < b.path; });
  return choices;
}

void list_scenes(Listing& listing) {
  const fs::path assets = assets_folder();
  listing.choices.scenes = scenes_in(assets / "scenes");
  listing.choices.extreme = scenes_in(assets / "scenes" / "extreme");
  for (const OpenChoice& choice : listing.choices.scenes) {
    const fs::path file = assets / "pictures" / "scenes" / choice.path.filename().replace_extension(".png");
    std::error_code failed;
    if (!fs::exists(file, failed)) continue;
    try {
      listing.pictures.emplace(choice.path, render::read_png(file));
    } catch (const InputError&) {  // no thumbnail
    }
  }
}

void list_folder(const fs::path& folder, panel::OpenChoices& choices) {
  std::error_code failed;
  choices.folder = folder;
  if (folder.has_relative_path()) choices.files.push_back({folder.parent_path(), "..", "parent folder", nullptr, true});
  std::vector<OpenChoice> folders, files;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    std::error_code unknown;
    if (name.starts_with('.')) continue;
    if (entry->is_directory(unknown)) folders.push_back({entry->path(), name, "folder", nullptr, true});
    const FileKind kind = kind_of(entry->path());
    if (!entry->is_regular_file(unknown) || kind == FileKind::other) continue;
    const auto bytes = entry->file_size(unknown);
    files.push_back({entry->path(), name, fmt::format("{}, {}", name_of(kind), size_text(unknown ? 0 : bytes))});
    if (files.size() + folders.size() > max_listed) {
      choices.problem =
          fmt::format("Only the first {} entries are listed; type a path that begins with / for others.", max_listed);
      break;
    }
  }
  if (failed) choices.problem = "The folder cannot be read: " + failed.message() + ".";
  for (std::vector<OpenChoice>* part : {&folders, &files}) {
    std::sort(part->begin(), part->end(), [](const OpenChoice& a, const OpenChoice& b) { return a.title < b.title; });
    choices.files.insert(choices.files.end(), part->begin(), part->end());
  }
}

}  // namespace

Listing list_choices(const fs::path& folder, bool with_scenes) {
  Listing listing;
  if (with_scenes) list_scenes(listing);
  for (const fs::path& file : recent_files()) {
    std::error_code failed;
    listing.choices.recent.push_back(
        {file, file.filename().string(), file.parent_path().string(), nullptr, false, fs::exists(file, failed)});
  }
  if (!folder.empty()) list_folder(folder, listing.choices);
  return listing;
}

void Library::list_folder(fs::path folder) {
  if (!folder.empty()) folder_ = std::move(folder);
  again_ = result_.valid();
  if (!again_) begin();
}

void Library::begin() {
  result_ = std::async(std::launch::async, [folder = folder_, with_scenes = scenes_.empty()] {
    struct Wake {
      ~Wake() { GlfwWindow::wake(); }
    } wake_at_end;
    return list_choices(folder, with_scenes);
  });
}

bool Library::is_ready() const {
  return result_.valid() && result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::optional<panel::OpenChoices> Library::take() {
  if (!is_ready()) return std::nullopt;
  Listing listing = result_.get();
  for (OpenChoice& choice : listing.choices.scenes) {
    const auto found = listing.pictures.find(choice.path);
    if (found == listing.pictures.end()) continue;
    const render::Image& image = found->second;
    const render::Texture& texture = pictures_.emplace_back();
    render::allocate_texture(texture, GL_RGB8, GL_RGB, GL_UNSIGNED_BYTE, image.size);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.size.width, image.size.height, GL_RGB, GL_UNSIGNED_BYTE,
                    image.pixels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glGenerateMipmap(GL_TEXTURE_2D);
    choice.thumbnail = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));
  }
  if (!listing.choices.scenes.empty()) {
    scenes_ = listing.choices.scenes;
    extreme_ = listing.choices.extreme;
  }
  listing.choices.scenes = scenes_;
  listing.choices.extreme = extreme_;
  if (std::exchange(again_, false)) begin();
  return std::move(listing.choices);
}

}  // namespace heml::window
