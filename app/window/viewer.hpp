#pragma once
// The contents of the window: the body of a session, the panel, and the mouse tool.
//
//    events ─┬─► mouse tool ──► commands ─┐
//            └─► panel ───────► actions ──┴─► session ──► frames ──► draw()
#include <app/panel/comparison_view.hpp>
#include <app/panel/interface.hpp>
#include <app/panel/panel.hpp>
#include <app/window/arrow_drag.hpp>
#include <app/window/device_hand.hpp>
#include <app/window/glfw_window.hpp>
#include <app/window/library.hpp>
#include <app/window/mouse_tool.hpp>
#include <app/window/selection_drag.hpp>
#include <app/window/session_loader.hpp>
#include <app/window/spacemouse.hpp>
#include <app/window/state_folder.hpp>
#include <app/window/timeline_playback.hpp>
#include <app/window/unsaved_work.hpp>
#include <app/window/video_recorder.hpp>
#include <app/window/window.hpp>
#include <array>
#include <chrono>
#include <functional>

namespace heml::window {

class Viewer final : public WindowEvents {
 public:
  /// Starts the session. Throws InputError as Session does. The window must outlive the viewer.
  Viewer(GlfwWindow& window, const Scene& scene, const WindowOptions& options);
  ~Viewer() override;

  /// Whether the next image would differ from the last one.
  bool wants_drawing() const;
  void draw();

  /// The last drawn image in one line, for scripts that drive the window: its number and tick; "running" or "paused";
  /// "busy" while results of earlier input are outstanding, "still" when nothing changes without input, else "ready";
  /// the last key pressed (panel/keys.hpp).
  std::string status() const;

  bool quits() const { return quits_; }
  void ask_to_quit();                             ///< quits, or asks first what is to become of unsaved work
  long drawn() const { return drawn_; }           ///< images so far
  /// The session's newest frame, also while a past one is shown: of how the session ends, past ones tell nothing.
  const Frame& newest() { return open_.session->latest(); }
  /// Why a recording of this window ended early; empty: none did.
  std::string recording_problem();

  /// Looks for devices that move hands and reads those that are there. Returns whether there are any: they are read
  /// again and again, since they send no events.
  bool read_devices();
  void apply_input();  ///< what came since the last call, in its order; some of it after the next picture
  void came(Input input) override;
  void changed() override { frames_wanted_ = settling_frames; }

 private:
  static constexpr auto past_is_read_only = "Past frame: Resume (B) continues from here, Esc returns to live.";
  static constexpr int settling_frames = 3;  ///< that Dear ImGui may need after an input

  bool is_busy() const;
  bool is_paused() const { return playback_.active() ? !playback_.playing() : frame_->paused; }
  int apply(const KeyInput& key);  // as InputQueue wants it; so are the others
  int apply(const CharacterInput&) { return 0; }
  int apply(const ButtonInput& button);
  int apply(const MotionInput& motion);
  int apply(const WheelInput& wheel);
  int apply(const DropInput& drop);
  void perform(panel::Action action);
  bool panel_takes(const ButtonInput& button);
  void press(const ButtonInput& button);
  void adopt(OpenScene opened);
  void take_opened();
  void open(const std::filesystem::path& path);
  void open_again(const BareMeshOptions& options);
  void list(const std::filesystem::path& folder);
  void resume();
  void seek(panel::Request where);
  void go_live();
  void follow_script();
  void update_title();
  void fit(const render::BoundingSphere& ball);
  render::BoundingSphere ball_of_bodies() const;
  void compare(const std::vector<std::string>& variants);
  void resume_with(const std::vector<std::string>& comparisons);
  const Frame& seen() const { return panel::frame_in_pane(*frame_, controller_.current()); }  ///< in the current pane
  float interface_scale() const;
  void draw_interface(float seconds);
  void remember_preferences();
  void show_mesh();
  void draw_marks();
  std::optional<render::Hit> hovered() const;
  bool is_on_clamp() const;           ///< the mouse
  bool is_on_section_handle() const;  ///< the mouse
  void carry_out(const panel::PanelActions& actions);
  void carry_out(panel::Request request);
  void post(std::vector<Command>& commands);
  void cancel_replay();
  void cancel_replay_for_edit();
  void end_recording();
  bool is_being_replaced() const;
  std::string why_busy() const;
  void ask_about_work(const std::string& title, std::function<void()> then);
  void offer_left_work();
  void answer(std::size_t which);
  bool save_work();
  void restore_work(const std::filesystem::path& file);
  void open_now(const std::filesystem::path& path, const BareMeshOptions& options = {},
                const std::vector<std::string>& comparisons = {});
  void release_tool();
  void release_hands();
  void move_hands(float seconds);
  void draw_reach();
  std::vector<panel::DeviceInfo> devices() const;
  render::HandDrawing hands() const;
  DeviceHand::Scene hand_scene() const {
    return {*frame_, *frame_->surface_mesh, mouse_tool_.section(), panel_->tool().radius};
  }
  void leave_clamp();
  void remove_tissue();
  void notify_saved(const std::string& text, const std::filesystem::path& folder);
  void save_screenshot();
  void save_scene();
  void save_measured();
  bool measures_at_mouse();
  bool selects_at_mouse(const ButtonInput& input);
  SelectionDrag::View selection_view() const {
    return {seen(), *seen().surface_mesh, controller_, mouse_tool_.section()};
  }
  void end_selection();
  enum class ArrowMeaning { force, gravity };
  std::optional<Arrow> arrow_of(ArrowMeaning meaning) const;
  std::optional<ArrowMeaning> arrow_at_mouse() const;
  bool takes_arrow();
  void end_arrow();
  void draw_arrows() const;
  void forget_selection();
  bool numbers_refined_mesh() const;
  void write_conditions(Scene& scene) const;
  void write_regions(Scene& scene) const;
  void toggle_recording();
  void add_video_frame();
  void use_view(const panel::PanelActions& actions);

  GlfwWindow& window_;
  WindowOptions options_;
  panel::Preferences preferences_ = read_preferences();
  panel::ComparisonView bodies_;
  panel::Interface interface_;
  panel::CameraController controller_;
  MouseTool mouse_tool_{controller_};
  /// A hand, and what moves it; null: nothing does.
  struct PluggedHand {
    DeviceHand hand;
    std::unique_ptr<HandDevice> device = nullptr;
  };
  PluggedHand gamepad_{{first_device_hand, controller_}}, spacemouse_{{first_device_hand + 1, controller_}};
  SpaceMouseFinder spacemouse_finder_;
  SessionLoader session_loader_;
  Library library_;
  OpenScene open_;
  Scene as_opened_;  ///< as read from the file, not resumed
  std::shared_ptr<const Conditions> opened_conditions_;  ///< of its first frame
  TimelinePlayback playback_;
  std::optional<int> shown_progress_;              ///< of session_loader_, %
  std::unique_ptr<VideoRecorder> video_recorder_;  ///< while recording and encoding
  std::optional<panel::Panel> panel_;
  panel::MeshOpenings openings_;  ///< of the bare mesh that is open
  bool mesh_folded_ = false;      ///< its section is
  const Frame* frame_ = nullptr;
  const Frame* live_ = nullptr;  ///< the engine's newest, while frame_ may be a past one

  InputQueue input_;
  SelectionDrag selection_drag_;
  ArrowDrag arrow_drag_;
  ArrowMeaning dragged_arrow_ = ArrowMeaning::force;
  std::array<bool, 3> panel_has_{};  ///< the press of a button, by number
  std::size_t next_event_ = 0;  ///< of the scene's script, that the panel does not show yet
  render::Vec2f mouse_{-1, -1};
  std::chrono::steady_clock::time_point drawn_at_{}, pressed_at_{};
  render::Vec2f pressed_where_{-1, -1};
  int frames_wanted_ = settling_frames;
  long drawn_ = 0;
  int last_key_ = 0;
  bool key_acted_ = false;  ///< the last key was an action: its letter, which comes after it, is not typed
  bool listed_ = false;            ///< a folder, before
  bool run_after_resume_ = false;  ///< the resumed session is to run
  UnsavedWork unsaved_;
  std::string recording_problem_;  ///< of a recording that ended early, also where another session came since
  std::optional<std::filesystem::path> left_work_;  ///< of another run of the program: it is asked about, or restored
  bool restores_ = false;                           ///< the session being prepared is that of left_work_
  std::function<void()> after_question_;            ///< unless it is cancelled
  bool drags_section_ = false;  ///< the left button went down on the handle of the section plane
  bool quits_ = false;
};

}  // namespace heml::window
