#include <fmt/format.h>

#include <algorithm>
#include <app/panel/quantity.hpp>
#include <app/panel/timeline.hpp>
#include <cmath>

namespace heml::panel {
namespace {

constexpr float bar_height = 2.1f, timeline_margin = 0.7f, widest_timeline = 60, buttons_width = 9.5f,
                button_gap = 0.6f, time_width = 4.6f, side = 0.7f, pad = 0.3f, knob = 0.46f, shortest_track = 5;  // em
constexpr float before_track = side + time_width, after_track = buttons_width + 0.9f;                             // em

constexpr ImGuiWindowFlags bar_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing;

std::string seconds_text(double seconds) {
  return seconds < 60 ? fmt::format("{:.2f} s", seconds)
                      : fmt::format("{}:{:04.1f}", static_cast<long>(seconds / 60), std::fmod(seconds, 60));
}

std::string time_hint(const Timeline& time) {
  return fmt::format(
      "Shown time since the start, s; a reset does not set it back. Left, Right and Home move too; Resume (B) "
      "continues "
      "from there.\n\n{} frames in memory, {:.1f} of {:.0f} MB. When full, every second frame is dropped.",
      time.frames, static_cast<double>(time.bytes) / 1e6, static_cast<double>(time.room) / 1e6);
}

/// The track and the mapping between ticks and pixels.
struct Track {
  ImVec2 from, to;
  const Timeline& time;
  float at(long tick) const {
    const double share = static_cast<double>(tick) / static_cast<double>(std::max(time.end, 1l));
    return from.x + static_cast<float>(std::clamp(share, 0.0, 1.0)) * (to.x - from.x);
  }
  long tick_at(float x) const {
    const double share = std::clamp((x - from.x) / std::max(1.0f, to.x - from.x), 0.0f, 1.0f);
    return std::lround(share * static_cast<double>(time.end));
  }
};

void draw_track(const Track& track) {
  const Timeline& time = track.time;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = (track.from.y + track.to.y) / 2, half = em(0.22f);
  const auto part = [&](float left, float right, ImU32 colour) {
    if (right > left) list.AddRectFilled({left, middle - half}, {right, middle + half}, colour, half);
  };
  part(track.from.x, track.to.x, colours::track);
  part(track.at(time.first), track.at(time.live), time.shown ? colours::faint : colours::fill);
  if (time.shown) part(track.at(time.first), track.at(*time.shown), colours::fill);
  if (time.fast_forward_target > 0)
    list.AddCircle({track.at(time.fast_forward_target), middle}, em(0.42f), colours::warning, 20, em(0.12f));
  list.AddCircleFilled({track.at(time.shown.value_or(time.live)), middle}, em(knob), colours::accent, 24);
}

void follow_mouse(Rows& rows, const Track& track, PanelActions& out) {
  const Timeline& time = track.time;
  // Wider than the track by the halves of the knob that stand out where it is at an end.
  ImGui::SetCursorScreenPos({track.from.x - em(knob), track.from.y});
  ImGui::InvisibleButton("track", {track.to.x - track.from.x + em(2 * knob), track.to.y - track.from.y});
  const float x = ImGui::GetIO().MousePos.x;
  long tick = track.tick_at(x);
  double seconds = seconds_at(time, tick);
  if (time.moment_at && tick <= time.live) {  // what is told is what a click shows
    const TimelineMoment moment = time.moment_at(tick);
    tick = moment.tick;
    seconds = moment.elapsed;
  }
  if (ImGui::IsItemActive() && (ImGui::IsMouseClicked(0) || ImGui::GetIO().MouseDelta.x != 0)) {
    if (tick <= time.live) out.seek_to = tick;
  }
  if (ImGui::IsItemDeactivated() && tick > time.live) out.seek_to = tick;  // ahead: once, on release
  rows.explain({"Timeline", ""});
  if (!ImGui::IsItemHovered()) return;
  // The tooltip is above the bar, so that it does not cover the buttons.
  ImGui::SetNextWindowPos({x, track.from.y - em(0.8f)}, ImGuiCond_Always, {0.5f, 1});
  ImGui::BeginTooltip();
  ImGui::Text("%s of %s", seconds_text(seconds).c_str(), seconds_text(seconds_at(time, time.end)).c_str());
  if (!ImGui::IsAnyMouseDown())
    ImGui::TextDisabled("%s", tick > time.live ? "release here to fast-forward to it" : "drag to show past frames");
  ImGui::EndTooltip();
}

/// The time at the left, buttons at the right and the track between them, or above them where that would be too short.
struct Layout {
  Area bar;
  bool two_rows;
  float row = em(bar_height - 2 * pad);

  explicit Layout(const Area& free) {
    const float width = std::min(free.width() - em(2 * timeline_margin), em(widest_timeline)),
                middle = (free.from.x + free.to.x) / 2;
    two_rows = width - em(before_track + after_track) < em(shortest_track);
    const float bottom = free.to.y - em(timeline_margin);
    bar = {{middle - width / 2, bottom - em(bar_height) - (two_rows ? row : 0)}, {middle + width / 2, bottom}};
  }
  float left() const { return bar.from.x + em(side); }
  float text_top() const { return bar.to.y - em(pad) - row; }
  float buttons() const { return bar.to.x - em(after_track - button_gap); }
  /// Also where there are no buttons: the track is not to move.
  Track track(const Timeline& time) const {
    const float top = bar.from.y + em(pad), aside = two_rows ? side + knob : 0;
    return {{bar.from.x + em(two_rows ? aside : before_track), top},
            {bar.to.x - em(two_rows ? aside : after_track), top + row},
            time};
  }
};

void draw_buttons(Rows& rows, const Timeline& time, std::vector<Action>& pressed) {
  const auto tell = [&](const std::string& text, const Label& label) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text.c_str());
    rows.explain(label);
  };
  if (time.resume_progress)
    return tell(fmt::format("Replaying {} %", *time.resume_progress),
                {"Replaying", "Replays the session up to that time as fast as possible; Esc cancels."});
  if (time.is_opening)
    return tell(
        "Opening …",
        {"Opening",
         "Another file is being read. What is done to this body meanwhile would be lost, so it takes no changes."});
  if (time.shown) {
    if (rows.button({"Resume",
                     "Resumes from this time by replaying the session up to it, bit for bit; a recording "
                     "(being written or opened) continues in a new file (B)."}))
      pressed.push_back(Action::resume);
    ImGui::SameLine(0, em(0.4f));
    if (rows.button({"Live", "Back to the live simulation (End, Esc)."})) pressed.push_back(Action::seek_live);
  } else if (time.fast_forward_target > 0) {
    if (rows.button({"Stop here", "Ends fast-forwarding at this time (End, Esc)."}))
      pressed.push_back(Action::seek_live);
  }
}

}  // namespace

double seconds_at(const Timeline& time, long tick) {
  if (!time.elapsed) return static_cast<double>(tick) / time.rate;
  return *time.elapsed + static_cast<double>(tick - time.shown.value_or(time.live)) / time.rate;
}

void draw_timeline(Rows& rows, const Timeline& time, const Area& free, std::vector<Action>& pressed, PanelActions& out,
                   Area& place) {
  const Layout layout(free);
  place = layout.bar;
  ImGui::SetNextWindowPos(place.from);
  ImGui::SetNextWindowSize({place.width(), place.height()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em(side), em(pad)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  if (ImGui::Begin("timeline", nullptr, bar_flags)) {
    const double seconds = seconds_at(time, time.shown.value_or(time.live));
    ImGui::SetCursorScreenPos({layout.left(), layout.text_top()});
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, time.shown ? colours::warning : colours::text);
    ImGui::TextUnformatted(seconds_text(seconds).c_str());
    ImGui::PopStyleColor();
    rows.explain({"Shown time", time_hint(time)});
    const Track track = layout.track(time);
    draw_track(track);
    follow_mouse(rows, track, out);
    ImGui::SetCursorScreenPos({layout.buttons(), layout.text_top()});
    draw_buttons(rows, time, pressed);
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace heml::panel
