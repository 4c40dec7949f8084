#pragma once
// Lists what can be opened, in a thread of its own: folders may be slow, and pictures are to be unpacked.
#include <app/panel/open_choices.hpp>
#include <app/render/gl_objects.hpp>
#include <app/render/image.hpp>
#include <future>
#include <map>
#include <optional>

namespace heml::window {

/// Scenes that come with heml, by title; files of a kind read_scene() takes, and folders; what was opened last.
struct Listing {
  panel::OpenChoices choices;
  std::map<std::filesystem::path, render::Image> pictures;  ///< of scenes, by their file
};

/// folder: empty for none. with_scenes: also those that come with heml, which do not change. Any thread.
Listing list_choices(const std::filesystem::path& folder, bool with_scenes);

/// Belongs to the OpenGL context that is current in take().
class Library {
 public:
  /// Begins to list a folder; the one before where it is empty.
  void list_folder(std::filesystem::path folder);
  bool under_way() const { return result_.valid(); }
  bool is_ready() const;  ///< there is something to take

  /// What came of it, once.
  std::optional<panel::OpenChoices> take();

 private:
  void begin();

  std::filesystem::path folder_;
  bool again_ = false;  ///< another folder was asked for meanwhile
  std::future<Listing> result_;
  std::vector<panel::OpenChoice> scenes_, extreme_;
  std::vector<render::Texture> pictures_;
};

}  // namespace heml::window
