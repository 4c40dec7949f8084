#pragma once
// What is in the window: the body of a session, the panel, and the hand that joins them.
//
//    events ──► hand ──► commands ─┐
//       └─────► panel ──► actions ─┴─► session ──► frames ──► draw()
#include <app/panel/comparison_view.hpp>
#include <app/panel/interface.hpp>
#include <app/panel/panel.hpp>
#include <app/window/glfw_window.hpp>
#include <app/window/library.hpp>
#include <app/window/mouse_tool.hpp>
#include <app/window/session_loader.hpp>
#include <app/window/timeline_playback.hpp>
#include <app/window/video_recorder.hpp>
#include <app/window/window.hpp>
#include <chrono>

namespace heml::window {

class Viewer final : public WindowEvents {
 public:
  /// Starts the session. Throws InputError as Session does. The window must outlive it.
  Viewer(GlfwWindow& window, const Scene& scene, const WindowOptions& options);
  ~Viewer() override;

  /// Whether a picture would differ from the last one.
  bool wants_drawing() const;
  void draw();

  /// The last picture in one line, by which scripts that drive the window know when to go on: its number, its tick,
  /// "running" or "paused"; "busy" while something done before is still to show, "still" when nothing changes by itself
  /// any more, else "ready"; and the key that was pressed last, as the panel counts them.
  std::string status() const;

  bool quits() const { return quits_; }
  long drawn() const { return drawn_; }           ///< pictures so far
  const Frame& frame() const { return *frame_; }  ///< the one drawn last

  void key(int key, bool control, bool repeated) override;
  void button(MouseButton button, bool down, bool shift) override;
  void mouse(const render::Vec2f& at) override;
  void wheel(float notches) override;
  void dropped(const std::filesystem::path& path) override;
  void changed() override { pictures_wanted_ = settling_pictures; }

 private:
  static constexpr auto past_is_fixed = "This is the past: Resume (B) goes on from here, Esc goes back to the present.";
  static constexpr int settling_pictures = 3;  ///< that Dear ImGui may take to settle after something was done

  bool is_busy() const;
  void adopt(OpenScene opened);
  void take_opened();
  void open(const std::filesystem::path& path);
  void list(const std::filesystem::path& folder);
  void resume();
  void look(panel::Request where);
  void to_the_present();
  void follow_script();
  void fit();
  void compare(const std::vector<std::string>& variants);
  void resume_with(const std::vector<std::string>& comparisons);
  const Frame& seen() const { return panel::body_in(*frame_, controller_.current()); }  ///< the body in the eye's pane
  void draw_interface(float seconds);
  void draw_marks();
  void carry_out(const panel::PanelActions& actions);
  void carry_out(panel::Request request);
  void post(std::vector<Command>& commands);
  void let_go();
  void remove_tissue();
  void save_screenshot();
  void save_scene();
  void film();
  void take_picture();
  void use_view(const panel::PanelActions& actions);

  GlfwWindow& window_;
  WindowOptions options_;
  panel::ComparisonView bodies_;
  panel::Interface interface_;
  panel::CameraController controller_;
  MouseTool mouse_tool_{controller_};
  SessionLoader session_loader_;
  Library library_;
  OpenScene open_;
  Scene as_opened_;  ///< of the file, not of what one went on from
  TimelinePlayback past_;
  std::optional<int> shown_progress_;              ///< of session_loader_, %
  std::unique_ptr<VideoRecorder> video_recorder_;  ///< while it goes on, and until its video is made
  std::optional<panel::Panel> panel_;
  const Frame* frame_ = nullptr;

  std::size_t next_event_ = 0;  ///< of the scene's script that the panel has not seen
  render::Vec2f mouse_{-1, -1};
  std::chrono::steady_clock::time_point drawn_at_{}, pressed_at_{};
  render::Vec2f pressed_where_{-1, -1};
  int pictures_wanted_ = settling_pictures;
  long drawn_ = 0;
  int last_key_ = 0;
  bool listed_ = false;    ///< folders, before
  bool plays_on_ = false;  ///< what goes on from here is to run
  bool quits_ = false;
};

}  // namespace heml::window
