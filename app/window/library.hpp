#pragma once
// Lists the entries of the open dialog on another thread: folders may be slow, and thumbnails are decoded.
#include <app/panel/open_choices.hpp>
#include <app/render/gl_objects.hpp>
#include <app/render/image.hpp>
#include <future>
#include <map>
#include <optional>

namespace heml::window {

/// Installed scenes, files that read_scene() accepts, folders, and recent files.
struct Listing {
  panel::OpenChoices choices;
  std::map<std::filesystem::path, render::Image> pictures;  ///< thumbnails by scene file
};

/// folder: empty for none. with_scenes: also installed scenes, which do not change. Any thread.
Listing list_choices(const std::filesystem::path& folder, bool with_scenes);

/// Owns textures of the OpenGL context that is current in take().
class Library {
 public:
  /// Starts to list a folder; empty: the last one again.
  void list_folder(std::filesystem::path folder);
  bool is_busy() const { return result_.valid(); }
  bool is_ready() const;  ///< take() returns a list

  /// A finished list, once, with thumbnails uploaded; nothing before.
  std::optional<panel::OpenChoices> take();

 private:
  void begin();

  std::filesystem::path folder_;
  bool again_ = false;  ///< another list was asked for meanwhile
  std::future<Listing> result_;
  std::vector<panel::OpenChoice> scenes_, extreme_;
  std::vector<render::Texture> pictures_;
};

}  // namespace heml::window
